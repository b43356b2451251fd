// SPDX-License-Identifier: GPL-3.0-or-later
// The page of a catalogue: a list that draws only what is seen, filters, a size matrix and a 3D view.
"use strict";
(() => {
const k_height = 110;  // px of a row; the style sheet's height and its border
const by_id = (id) => document.getElementById(id);
const column = Object.fromEntries(catalogue.columns.map((name, index) => [name, index]));
const places = catalogue.columns.filter((name) => name.startsWith("ease_"));
const filters = ["body", "garment", "verdict", "reason"];
let shown = catalogue.rows;

function value(row, name) { return row[column[name]]; }

function outfit(row) {
  return [value(row, "garment"), value(row, "size"), words(value(row, "variant"))].filter(Boolean).join(" · ");
}

function element(tag, text, style) {
  const made = document.createElement(tag);
  made.textContent = text;
  if (style) made.className = style;
  return made;
}

function words(name) { return String(name ?? "").replaceAll("_", " "); }

function centimetres(metres) { return metres == null ? "–" : `${(100 * metres).toFixed(1)} cm`; }

function fill_choices() {
  for (const name of filters) {
    const choices = [...new Set(catalogue.rows.map((row) => value(row, name)))].filter((each) => each != null).sort();
    by_id(name).append(new Option("all", ""), ...choices.map((each) => new Option(words(each), each)));
    by_id(name).addEventListener("change", update);
  }
  by_id("place").append(...places.map((name) => new Option(words(name.slice(5)), name)));
  const most = places.map((name) => catalogue.rows.filter((row) => value(row, name) != null).length);
  by_id("place").selectedIndex = most.indexOf(Math.max(...most));
  for (const name of ["place", "sort"]) by_id(name).addEventListener("change", update);
  by_id("causes").append(...catalogue.summary.map(([reason, count]) => {
    const line = element("tr", "");
    line.append(element("td", words(reason)), element("td", count));
    return line;
  }));
}

function update() {
  const wanted = filters.map((name) => [column[name], by_id(name).value]).filter(([, text]) => text !== "");
  shown = catalogue.rows.filter((row) => wanted.every(([index, text]) => row[index] === text));
  const sign = { up: 1, down: -1 }[by_id("sort").value];
  if (sign) {
    const ease = column[by_id("place").value];
    shown.sort((a, b) => (a[ease] == null) - (b[ease] == null) || sign * (a[ease] - b[ease]));
  }
  by_id("count").textContent = `${shown.length} of ${catalogue.rows.length} pairs`;
  by_id("space").style.height = `${shown.length * k_height}px`;
  by_id("list").scrollTop = 0;
  draw_rows();
}

function draw_rows() {
  const list = by_id("list");
  const first = Math.max(0, Math.floor(list.scrollTop / k_height) - 3);
  const last = Math.min(shown.length, Math.ceil((list.scrollTop + list.clientHeight) / k_height) + 3);
  const focused = document.activeElement?.dataset?.index;
  by_id("space").replaceChildren(...Array.from({ length: last - first }, (_, index) => make_row(first + index)));
  if (focused) by_id("space").querySelector(`[data-index="${focused}"]`)?.focus({ preventScroll: true });
}

function make_row(index) {
  const row = shown[index];
  const made = element("button", "", "row");
  made.dataset.index = index;
  made.style.top = `${index * k_height}px`;
  const picture = new Image();
  picture.alt = "front, back and ease";
  if (value(row, "picture")) picture.src = `${value(row, "folder")}/thumbnail.png`;
  else picture.style.visibility = "hidden";
  const done = value(row, "reason") === "done";
  made.append(picture,
    element("span", `${outfit(row)} on ${value(row, "body")}`),
    element("span", words(done ? value(row, "verdict") ?? "done" : value(row, "reason")), done ? "good" : "bad"),
    element("span", value(row, "message") && !done || !value(row, "type") ? value(row, "message")
      : `ease ${centimetres(value(row, by_id("place").value))}, ${words(value(row, "type"))}`));
  made.addEventListener("click", () => open_pair(row));
  return made;
}

function move_focus(event) {
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const next = Math.min(shown.length - 1, Math.max(0, Number(document.activeElement.dataset.index ?? -1) + step));
  const list = by_id("list");
  if (next * k_height < list.scrollTop) list.scrollTop = next * k_height;
  if ((next + 1) * k_height > list.scrollTop + list.clientHeight)
    list.scrollTop = (next + 1) * k_height - list.clientHeight;
  draw_rows();
  by_id("space").querySelector(`[data-index="${next}"]`)?.focus({ preventScroll: true });
}

function show_matrix() {
  const matrix = by_id("matrix");
  matrix.hidden = !matrix.hidden;
  by_id("matrix-button").setAttribute("aria-expanded", String(!matrix.hidden));
  if (matrix.childElementCount || matrix.hidden) return;
  const bodies = [...new Set(catalogue.rows.map((row) => value(row, "body")))].sort();
  const cells = new Map();
  for (const row of catalogue.rows) {
    const name = outfit(row);
    if (!cells.has(name)) cells.set(name, new Map());
    cells.get(name).set(value(row, "body"), row);
  }
  const table = element("table", ""), head = element("tr", "");
  head.append(element("th", "garment"), ...bodies.map((body) => element("th", body)));
  table.append(head);
  for (const [name, of_body] of cells) {
    const line = element("tr", "");
    line.append(element("th", name), ...bodies.map((body) => {
      const row = of_body.get(body);
      const done = row && value(row, "reason") === "done";
      return element("td", row ? words(done ? value(row, "verdict") : value(row, "reason")) : "",
                     done ? "good" : "bad");
    }));
    table.append(line);
  }
  matrix.append(table);
}

// ---- the view of one pair

const ramps = { ease: [0, 0.05, 100, "cm"], strain: [0.15, -0.02, 100, "%"], pressure: [2000, 0, 1, "Pa"] };
let scene_of_pair = null;

function load_script(path) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = path;
    script.onload = () => { script.remove(); resolve(); };
    script.onerror = () => { script.remove(); reject(new Error(path)); };
    document.head.append(script);
  });
}

async function open_pair(row) {
  by_id("title").textContent = `${outfit(row)} on ${value(row, "body")}`;
  by_id("ended").textContent = `${words(value(row, "reason"))}. ${value(row, "message") ?? ""}`;
  by_id("report").textContent = by_id("log").textContent = "";
  scene_of_pair = null;
  by_id("canvas").hidden = true;
  by_id("viewer").showModal();
  const log = by_id("log-file");
  log.hidden = !value(row, "folder");
  log.href = `${value(row, "folder")}/log.txt`;
  if (!value(row, "view")) return;
  try {
    if (!window.THREE) await load_script("page/three.min.js");
    await load_script(`${value(row, "folder")}/view.js`);
  } catch (error) {
    by_id("log").textContent = `no view was kept (${error.message})`;
  }
}

function array_of(text, Type) {
  return new Type(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
}

function make_mesh(packed, index) {
  const raw = array_of(packed.positions, Uint16Array);
  const positions = Float32Array.from(raw, (each, place) => packed.low[place % 3] + packed.step * each);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  geometry.setIndex(new THREE.BufferAttribute(array_of(packed.triangles, Uint32Array), 1));
  geometry.computeVertexNormals();
  const plain = index === 0 ? 0xc7b3a3 : [0x406ba8, 0x994d4d, 0x4d855c, 0x8c7333][(index - 1) % 4];
  const material = new THREE.MeshStandardMaterial({ color: plain, side: THREE.DoubleSide, roughness: 0.9 });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.userData = { plain, values: packed.values };
  return mesh;
}

function colour(share) {
  const stops = [[0.80, 0.15, 0.15], [0.95, 0.80, 0.30], [0.20, 0.40, 0.75]];
  const at = 2 * Math.min(1, Math.max(0, share)), from = Math.min(1, Math.floor(at));
  return stops[from].map((low, index) => low + (stops[from + 1][index] - low) * (at - from));
}

function paint() {
  const name = by_id("colours").value;
  const [red, blue, factor, unit] = ramps[name] ?? [];
  by_id("legend").replaceChildren();
  if (name) by_id("legend").append(`${red * factor} ${unit} `, element("i", ""), ` ${blue * factor} ${unit}`);
  for (const mesh of scene_of_pair?.meshes ?? []) {
    const text = mesh.userData.values[name];
    if (text) {
      const colours = Array.from(array_of(text, Float32Array), (each) => colour((each - red) / (blue - red))).flat();
      mesh.geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    }
    mesh.material.vertexColors = Boolean(text);
    mesh.material.color.set(text ? 0xffffff : mesh.userData.plain);
    mesh.material.needsUpdate = true;
  }
  render();
}

let renderer = null;
const eye = { turn: 0, tilt: 0.1, distance: 1 };

window.showPair = (pair) => {
  by_id("report").textContent = pair.report;
  by_id("log").textContent = pair.log;
  if (!pair.meshes.length) return;
  by_id("canvas").hidden = false;
  renderer ??= new THREE.WebGLRenderer({ canvas: by_id("canvas"), antialias: true, preserveDrawingBuffer: true });
  const scene = new THREE.Scene(), meshes = pair.meshes.map(make_mesh);
  scene.background = new THREE.Color(matchMedia("(prefers-color-scheme: dark)").matches ? 0x202225 : 0xf4f4f4);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x888888, 1.6), ...meshes);
  const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100), lamp = new THREE.DirectionalLight(0xffffff, 1.6);
  camera.add(lamp);
  scene.add(camera);
  const box = new THREE.Box3().setFromObject(scene);
  const centre = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3()).length();
  Object.assign(eye, { turn: 0, tilt: 0.1, distance: 1.5 * size });
  scene_of_pair = { scene, camera, centre, meshes };
  paint();
};

function render() {
  if (!scene_of_pair) return;
  const { scene, camera, centre } = scene_of_pair, canvas = by_id("canvas");
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
  camera.aspect = canvas.clientWidth / Math.max(1, canvas.clientHeight);
  camera.updateProjectionMatrix();
  const flat = Math.cos(eye.tilt) * eye.distance;
  camera.position.set(centre.x + Math.sin(eye.turn) * flat, centre.y + Math.sin(eye.tilt) * eye.distance,
                      centre.z + Math.cos(eye.turn) * flat);
  camera.lookAt(centre);
  renderer.render(scene, camera);
}

function move_eye(turn, tilt, zoom) {
  eye.turn += turn;
  eye.tilt = Math.min(1.5, Math.max(-1.5, eye.tilt + tilt));
  eye.distance *= zoom;
  render();
}

function listen() {
  by_id("list").addEventListener("scroll", draw_rows);
  by_id("list").addEventListener("keydown", move_focus);
  by_id("matrix-button").addEventListener("click", show_matrix);
  by_id("colours").addEventListener("change", paint);
  addEventListener("resize", () => { draw_rows(); render(); });
  const canvas = by_id("canvas");
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons) move_eye(-event.movementX * 0.01, event.movementY * 0.01, 1);
  });
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); move_eye(0, 0, event.deltaY > 0 ? 1.1 : 0.9); },
                          { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const moves = { ArrowLeft: [-0.1, 0, 1], ArrowRight: [0.1, 0, 1], ArrowUp: [0, 0.1, 1], ArrowDown: [0, -0.1, 1],
                    "+": [0, 0, 0.9], "-": [0, 0, 1.1] };
    if (moves[event.key]) { event.preventDefault(); move_eye(...moves[event.key]); }
  });
}

fill_choices();
listen();
update();
})();
