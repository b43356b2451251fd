// SPDX-License-Identifier: GPL-3.0-or-later
// An outfit as a browser draws it: in three.js in a headless Chromium, in its rest pose and with its left upper arm
// turned. The silhouettes are compared with those of the file's own triangles, skinned here without a graphics
// processor. Run by scripts/check-outfit --browser. argv: FILE CHROMIUM [PICTURE.png]
import { spawn } from "child_process";
import fs from "fs";
import http from "http";
import os from "os";
import path from "path";
import { fileURLToPath } from "url";

const [file, chromium, picture] = process.argv.slice(2);
const tools = path.dirname(fileURLToPath(import.meta.url));
const k_most_unlike = 0.01;  // share of the silhouette's pixels; single pixels at edges differ
const k_seconds = 120;

/** In the page: draws the file, and posts what became of it. */
async function draw() {
    const three = await import("three");
    const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
    const { RoomEnvironment } = await import("three/addons/environments/RoomEnvironment.js");
    const size = 512, canvas = document.querySelector("canvas");
    canvas.width = canvas.height = size;
    const renderer = new three.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    const { scene } = await new GLTFLoader().loadAsync("/outfit");
    const backdrop = new three.Scene();
    backdrop.background = new three.Color(1, 0, 1);
    backdrop.environment = new three.PMREMGenerator(renderer).fromScene(new RoomEnvironment()).texture;
    backdrop.add(scene);
    const meshes = [];
    scene.traverse((node) => node.isMesh && meshes.push(node));
    const camera = new three.OrthographicCamera(-1.2, 1.2, 1.2, -1.2, 0.1, 20);

    /** A triangle's pixels where their centres are inside. */
    const fill = (mask, [a, b, c]) => {
        const side = (p, q, x, y) => (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
        const range = (k) => [Math.max(0, Math.floor(Math.min(a[k], b[k], c[k]))),
                              Math.min(size - 1, Math.ceil(Math.max(a[k], b[k], c[k])))];
        const [x0, x1] = range("x"), [y0, y1] = range("y");
        for (let y = y0; y <= y1; ++y)
            for (let x = x0; x <= x1; ++x) {
                const s = [side(a, b, x + 0.5, y + 0.5), side(b, c, x + 0.5, y + 0.5), side(c, a, x + 0.5, y + 0.5)];
                if (s.every((v) => v >= 0) || s.every((v) => v <= 0)) mask[y * size + x] = 1;
            }
    };
    const silhouette = () => {
        const mask = new Uint8Array(size * size);
        for (const mesh of meshes) {
            const corners = Array.from({ length: mesh.geometry.attributes.position.count }, (_, v) => {
                const p = mesh.getVertexPosition(v, new three.Vector3()).applyMatrix4(mesh.matrixWorld).project(camera);
                return { x: (p.x + 1) / 2 * size, y: (p.y + 1) / 2 * size };
            });
            const index = mesh.geometry.index.array;
            for (let i = 0; i < index.length; i += 3) fill(mask, [0, 1, 2].map((k) => corners[index[i + k]]));
        }
        return mask;
    };
    const compare = () => {
        scene.updateMatrixWorld(true);
        for (const mesh of meshes) mesh.skeleton?.update();
        renderer.render(backdrop, camera);
        const gl = renderer.getContext(), pixels = new Uint8Array(4 * size * size);
        gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        const expected = silhouette();
        let covered = 0, unlike = 0, dark = 0;
        for (let i = 0; i < expected.length; ++i) {
            const [r, g, b] = pixels.subarray(4 * i, 4 * i + 3), drawn = !(r > 250 && g < 5 && b > 250);
            covered += expected[i];
            unlike += drawn !== (expected[i] === 1);
            dark += drawn && r + g + b < 30;
        }
        return { covered, unlike: unlike / covered, dark: dark / covered };
    };

    const box = new three.Box3().setFromObject(scene), middle = box.getCenter(new three.Vector3());
    camera.position.set(middle.x, middle.y, middle.z + 10);
    camera.zoom = 2.2 / Math.max(...box.getSize(new three.Vector3()).toArray());
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
    const at_rest = compare(), image = canvas.toDataURL();
    const bones = meshes.flatMap((mesh) => mesh.skeleton?.bones ?? []);
    const plain = (name) => name.toLowerCase().replace(/mixamorig|j_bip|[^a-z]/g, "");
    const arm = ["leftupperarm", "lupperarm", "leftarm", "upperarml", "lhumerus", "leftshoulder"]
        .map((name) => bones.find((bone) => plain(bone.name) === name)).find(Boolean);
    if (arm) arm.rotateZ(0.6);
    const turned = compare();
    return { at_rest, turned, arm: arm?.name, image };
}

const page = `<!DOCTYPE html><canvas></canvas>
<script type="importmap">{"imports": {"three": "/node_modules/three/build/three.module.js",
                                      "three/addons/": "/node_modules/three/examples/jsm/"}}</script>
<script type="module">
const post = (body) => fetch("/result", { method: "POST", body: JSON.stringify(body) });
(${draw})().then(post, (error) => post({ error: String(error.stack ?? error) }));
</script>`;

function fail(what) {
    console.error(`${file}: ${what}`);
    process.exitCode = 1;
}

function judge(result) {
    if (result.error) return fail(result.error);
    if (picture) fs.writeFileSync(picture, Buffer.from(result.image.split(",")[1], "base64"));
    if (!result.arm) fail("no joint of a left upper arm was found");
    for (const [pose, picture_of] of [["at rest", result.at_rest], ["turned", result.turned]]) {
        const { covered, unlike, dark } = picture_of;
        if (covered < 2000) fail(`${pose}: only ${covered} pixels of 512 x 512 are covered`);
        if (unlike > k_most_unlike) fail(`${pose}: ${(100 * unlike).toFixed(2)} % of the silhouette differ`);
        if (dark > 0.9) fail(`${pose}: the picture is black`);
    }
    const percent = (share) => `${(100 * share).toFixed(2)} %`;
    console.log(`${file}: silhouettes in Chromium differ in ${percent(result.at_rest.unlike)} of their pixels, `
                + `${percent(result.turned.unlike)} with ${result.arm} turned`);
}

const profile = fs.mkdtempSync(path.join(os.tmpdir(), "outfit-"));
let browser, timer;
function remove_profile() {
    try {
        fs.rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
    } catch (error) {
        console.error(`${profile} is left: ${error.message}`);  // says nothing of the outfit
    }
}
function end() {
    clearTimeout(timer);
    if (browser.pid) process.kill(-browser.pid, "SIGKILL");  // its children, too, which write to the profile
    server.closeAllConnections();
    server.close();
}
const types = { ".js": "text/javascript", ".mjs": "text/javascript" };
const server = http.createServer((request, response) => {
    const send = (body, type) => response.writeHead(200, { "Content-Type": type }).end(body);
    if (request.url === "/result") {
        let body = "";
        request.on("data", (part) => (body += part)).on("end", () => {
            response.end();
            judge(JSON.parse(body));
            end();
        });
    } else if (request.url === "/") send(page, "text/html");
    else if (request.url === "/outfit") send(fs.readFileSync(file), "model/gltf-binary");
    else {
        const asked = path.join(tools, path.normalize(request.url));
        if (fs.existsSync(asked)) send(fs.readFileSync(asked), types[path.extname(asked)] ?? "text/plain");
        else response.writeHead(404).end();
    }
});
server.listen(0, "127.0.0.1", () => {
    const flags = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                   "--no-first-run", "--disable-dev-shm-usage", `--user-data-dir=${profile}`];
    const address = `http://127.0.0.1:${server.address().port}/`;
    browser = spawn(chromium, [...flags, address], { stdio: "ignore", detached: true });
    browser.on("exit", remove_profile);
    browser.on("error", (error) => { fail(error.message); end(); remove_profile(); });
    timer = setTimeout(() => { fail(`Chromium said nothing for ${k_seconds} s`); end(); }, 1000 * k_seconds);
});
