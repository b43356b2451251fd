# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pairs a plan names."""
import pytest

pytest.importorskip("distributed")
from garmentfit.catalogue.plan import Hashes, PlanError, read_plan  # noqa: E402


@pytest.fixture
def folder(tmp_path):
    for name in ("anna.ply", "ben.ply", "coat_S.ply", "coat_M.ply", "shirt.ply"):
        (tmp_path / name).write_text(name)
    return tmp_path


def write(folder, text, name="plan.toml"):
    (folder / name).write_text(text)
    return folder / name


def test_bodies_times_sizes_times_parameters(folder):
    plan = read_plan(write(folder, """
        bodies = ["anna.ply", "b*.ply"]
        [[garments]]
        layers = ["shirt.ply", "coat_{size}.ply"]
        sizes = ["S", "M"]
        types = ["blouse", "coat"]
        [vary]
        fabric = ["cotton", "wool", "silk"]
        [limits]
        seconds = 5
    """))
    assert len(plan.pairs) == 2 * 2 * 3 and plan.limits.seconds == 5
    first = plan.pairs[0]
    assert [layer.rsplit("/")[-1] for layer in first.layers] == ["shirt.ply", "coat_S.ply"]
    assert first.flags() == ["--type", "blouse", "--type", "coat", "--fabric", "cotton"]


def test_zip_pairs_the_lists_and_refuses_lists_of_different_length(folder):
    text = 'bodies = ["anna.ply", "ben.ply"]\ngarment_files = {}\npairs = "zip"\n'
    plan = read_plan(write(folder, text.format('["coat_S.ply", "shirt.ply"]')))
    assert [pair.garment for pair in plan.pairs] == ["coat_S", "shirt"]
    with pytest.raises(PlanError, match="2 bodies and 1 garments"):
        read_plan(write(folder, text.format('["shirt.ply"]')))


def test_csv_columns_that_are_not_files_are_parameters(folder):
    plan = read_plan(write(folder, "body,garment,size,fabric\nanna.ply,shirt.ply;coat_M.ply,M,wool\n", "plan.csv"))
    assert plan.pairs[0].parameters == (("fabric", "wool"),) and len(plan.pairs[0].layers) == 2


@pytest.mark.parametrize("text, words", [
    ('bodies = ["nobody*.ply"]', "no file matches"), ('bodys = ["anna.ply"]', "unknown key bodys"),
    ('bodies = ["anna.ply"]', "no pair"),
    ('limits = { threads = 0.5 }', "threads = 0.5; give a positive number"), ("bodies = [", "plan.toml"),
    ('bodies = ["anna.ply"]\n[[garments]]\nlayers = ["hat.ply"]', "no such file")])
def test_a_wrong_plan_is_refused_in_one_line(folder, text, words):
    with pytest.raises(PlanError, match=words) as caught:
        read_plan(write(folder, text))
    assert "\n" not in str(caught.value)


def test_the_name_of_a_pair_follows_content_parameters_and_version_but_not_the_body_s_place(folder):
    text = 'bodies = ["{}"]\ngarment_files = ["shirt.ply"]\n[parameters]\nfabric = "{}"\n'
    (folder / "same.ply").write_text("anna.ply")

    def key(body, fabric="wool", version="1"):
        return Hashes().of_pair(read_plan(write(folder, text.format(body, fabric))).pairs[0], version)
    assert key("anna.ply") == key("same.ply")
    assert len({key("anna.ply"), key("ben.ply"), key("anna.ply", "silk"), key("anna.ply", version="2")}) == 4
