# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a catalogue in Debian's Chromium, opened from disk."""
import io
import json
import shutil
from unittest import mock

import numpy as np
import pytest
from PIL import Image

for needed in ("distributed", "psutil", "pyarrow", "tqdm"):
    pytest.importorskip(needed)
sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
from garmentfit.catalogue import drawing, page, results  # noqa: E402
from garmentfit.catalogue.store import Store  # noqa: E402

CHROMIUM = shutil.which("chromium")
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="Debian's chromium is not installed")
FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


@pytest.fixture(scope="module")
def browser():
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield started
        started.close()


@pytest.fixture
def errors():
    return []


def open_page(browser, folder, errors, **context):
    opened = browser.new_context(**context).new_page()
    opened.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.goto((folder / "index.html").as_uri())
    return opened


def write_tube(path, radius):
    """A tube of radius and height 1 m as the program writes fit maps."""
    turn, height = np.meshgrid(np.linspace(0, 2 * np.pi, 24, endpoint=False), [0, 0.5, 1])
    fields = [(name, "<f8") for name in ("x", "y", "z", "ease", "strain", "pressure")]
    vertices = np.zeros(turn.size, fields)
    vertices["x"], vertices["z"] = radius * np.cos(turn).ravel(), radius * np.sin(turn).ravel()
    vertices["y"] = height.ravel()
    vertices["ease"] = np.linspace(0, 0.05, turn.size)
    at = np.arange(48)
    side = at // 24 * 24 + (at + 1) % 24
    corners = np.concatenate([np.stack([at, side, at + 24], 1), np.stack([side, side + 24, at + 24], 1)])
    faces = np.zeros(len(corners), [("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, corners
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertices)}",
            *(f"property double {name}" for name, _ in fields), f"element face {len(faces)}",
            "property list uchar int vertex_indices", "end_header", ""]
    path.write_bytes("\n".join(head).encode() + vertices.tobytes() + faces.tobytes())


@mock.patch("os.fsync", new=lambda _: None)  # it would take minutes for 10,000 rows
def make_catalogue(folder, bodies, garments, drawn=0, fabrics=("wool",)):
    """A catalogue with results; the first `drawn` of them have meshes."""
    store, pairs = Store(folder), {}
    store.create()
    for index in range(bodies * garments):
        body, garment = index % bodies, index // bodies
        key = f"{index % 256:02x}{index:022x}"
        pairs[key] = dict(body=f"/b/body{body}.ply", garment=f"coat{garment}", layers=["/g/coat.ply"], types=[],
                          size="M", body_parameters=[], parameters=[("fabric", fabrics[index % len(fabrics)])])
        good = index % 10 != 3
        row = dict(exit=0 if good else 3, reason="done" if good else "too_small", message="", type="coat",
                   verdict="fits" if index % 2 else "tight", ease_waist=(index * 7919 % 1000) / 10000)
        work = store.start(key)
        (work / "log.txt").write_text("what the program said\n")
        if index < drawn:
            (work / "result" / "maps").mkdir(parents=True)
            write_tube(work / "result" / "body.ply", 0.2)
            write_tube(work / "result" / "maps" / "coat.ply", 0.25)
            report = {"body": {"up": [0, 1, 0], "front": [0, 0, 1], "metres_per_unit": 1},
                      "garments": [{"file": "coat.obj"}]}
            (work / "result" / "report.json").write_text(json.dumps(report))
            drawing.draw_pair(work, row)
        store.finish("dress", key, work, row)
    store.write_plan(pairs)
    page.write_page(store, results.collect(store))
    return store


def test_filters_sorts_and_shows_a_pair_without_an_error(browser, errors, tmp_path):
    make_catalogue(tmp_path, 3, 4, drawn=12)
    opened = open_page(browser, tmp_path, errors)
    assert opened.locator("#count").inner_text() == "12 of 12 pairs"
    opened.click("header summary")
    assert opened.locator("#causes").inner_text().split("\n") == ["done\t11", "too small\t1"]
    opened.select_option("#body", "body1")
    assert opened.locator("#count").inner_text() == "4 of 12 pairs"
    assert opened.locator(".row").count() == 4
    opened.select_option("#body", "")
    opened.select_option("#sort", "up")
    first = opened.locator(".row").first
    assert "ease 0.0 cm" in first.inner_text()
    assert first.locator("img").evaluate("image => image.decode().then(() => image.naturalWidth)") > 200
    opened.select_option("#reason", "too_small")
    assert "ease 7.6 cm, coat" in opened.locator(".row").last.inner_text()  # it is known of what is too small, too
    opened.select_option("#reason", "")
    first.click()
    opened.wait_for_selector("#canvas:not([hidden])")
    plain = colours_of(opened)
    assert plain > 5  # an empty canvas has one colour
    opened.select_option("#colours", "ease")
    assert colours_of(opened) > plain and "cm" in opened.locator("#legend").inner_text()
    assert "what the program said" in opened.locator("#log").text_content()
    assert '"garments"' in opened.locator("#report").text_content()
    assert errors == []


def colours_of(opened):
    """How many colours the viewer's canvas has, 4 bits a channel."""
    return opened.evaluate("""() => {
        const from = document.getElementById("canvas"), to = document.createElement("canvas");
        to.width = from.width; to.height = from.height;
        const context = to.getContext("2d");
        context.drawImage(from, 0, 0);
        const pixels = context.getImageData(0, 0, to.width, to.height).data, seen = new Set();
        for (let at = 0; at < pixels.length; at += 4)
            seen.add((pixels[at] >> 4) * 256 + (pixels[at + 1] >> 4) * 16 + (pixels[at + 2] >> 4));
        return seen.size;
    }""")


def test_works_with_the_keyboard_on_a_phone_in_the_dark(browser, errors, tmp_path):
    make_catalogue(tmp_path, 3, 4, drawn=1)
    opened = open_page(browser, tmp_path, errors, viewport={"width": 360, "height": 640}, color_scheme="dark")
    assert opened.evaluate("document.documentElement.scrollWidth") <= 360
    opened.focus("#list")
    opened.keyboard.press("ArrowDown")
    opened.keyboard.press("Enter")
    opened.wait_for_selector("#canvas:not([hidden])")
    assert opened.evaluate("document.getElementById('viewer').scrollWidth") <= 360
    opened.keyboard.press("Escape")
    assert not opened.locator("#viewer").is_visible()
    assert errors == []


@pytest.mark.parametrize("scheme, is_right", [("light", lambda tone: tone > 200), ("dark", lambda tone: tone < 70)])
def test_page_and_viewer_follow_the_mode(browser, errors, tmp_path, scheme, is_right):
    make_catalogue(tmp_path, 1, 1, drawn=1)
    opened = open_page(browser, tmp_path, errors, color_scheme=scheme)
    assert is_right(usual_tone(opened))
    opened.locator(".row").first.click()
    opened.wait_for_selector("#canvas:not([hidden])")
    assert is_right(usual_tone(opened.locator("#canvas")))
    assert errors == []


def usual_tone(shown):
    """Median of the pixels' brightness, 0 to 255: that of the background."""
    return np.median(np.asarray(Image.open(io.BytesIO(screenshot_of(shown))).convert("L")))


def screenshot_of(shown):
    """On a crowded machine Chromium may be unable to take one at once."""
    try:
        return shown.screenshot()
    except sync_api.Error:
        return shown.screenshot()


def test_the_size_matrix_has_a_verdict_for_each_garment_and_body(browser, errors, tmp_path):
    make_catalogue(tmp_path, 3, 4)
    opened = open_page(browser, tmp_path, errors)
    opened.click("#matrix-button")
    cells = opened.locator("#matrix td").all_inner_texts()
    assert len(cells) == 12 and set(cells) == {"fits", "tight", "too small"}


def test_rows_of_one_garment_with_other_parameters_can_be_told_apart(browser, errors, tmp_path):
    make_catalogue(tmp_path, 1, 4, fabrics=("wool", "silk"))
    store = Store(tmp_path)
    pairs = store.read_plan()
    store.write_plan({key: {**pair, "garment": "coat"} for key, pair in pairs.items()})
    page.write_page(store, results.collect(store))
    opened = open_page(browser, tmp_path, errors)
    assert "coat · M · fabric silk on body0" in opened.locator(".row").nth(1).inner_text()
    opened.click("#matrix-button")
    assert opened.locator("#matrix th").all_inner_texts() == ["garment", "body0", "coat · M · fabric wool",
                                                              "coat · M · fabric silk"]
    assert errors == []


def test_ten_thousand_rows_stay_quick(browser, tmp_path):
    make_catalogue(tmp_path, 50, 200)
    paints = []
    for _ in range(3):  # the quickest: what the page needs, and not other programs
        opened = open_page(browser, tmp_path, [])
        opened.wait_for_function("performance.getEntriesByName('first-contentful-paint').length > 0")
        paints.append(opened.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime"))
    paint = min(paints)
    assert opened.locator("#count").inner_text() == "10000 of 10000 pairs"
    filtering = opened.evaluate("""() => {
        const start = performance.now();
        document.getElementById("body").value = "body7";
        document.getElementById("body").dispatchEvent(new Event("change"));
        document.getElementById("list").getBoundingClientRect();
        return performance.now() - start;
    }""")
    print(f"first paint {paint:.0f} ms, filter {filtering:.1f} ms")
    assert opened.locator("#count").inner_text() == "200 of 10000 pairs"
    assert paint < 1000 and filtering < 100
    assert opened.locator(".row").count() < 60  # only what is seen is drawn
