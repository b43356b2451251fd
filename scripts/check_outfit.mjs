// SPDX-License-Identifier: GPL-3.0-or-later
// The Khronos validator, and three.js with three-vrm. Run by scripts/check-outfit.
import fs from "fs";
import validator from "gltf-validator";
import * as three from "three";
import { VRMLoaderPlugin } from "@pixiv/three-vrm";

globalThis.self = globalThis;  // a browser, as far as the loader needs one: pictures are not decoded
globalThis.createImageBitmap = async () => ({ width: 1, height: 1 });
const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");

function fail(what) {
    console.error(`${file}: ${what}`);
    process.exit(1);
}

/** Whether turning the joint moves vertices of the mesh. */
function is_moved_by(mesh, joint) {
    const before = [], place = new three.Vector3(), count = mesh.geometry.attributes.position.count;
    const read = () => {
        mesh.skeleton.bones[0].updateWorldMatrix(true, true);
        mesh.skeleton.update();
        return Array.from({ length: count }, (_, v) => mesh.getVertexPosition(v, place).toArray());
    };
    before.push(...read());
    const old = joint.quaternion.clone();
    joint.quaternion.multiply(new three.Quaternion().setFromAxisAngle(new three.Vector3(1, 0, 0), 0.5));
    const after = read();
    joint.quaternion.copy(old);
    return before.some((p, v) => Math.hypot(...p.map((x, k) => x - after[v][k])) > 1e-3);
}

const file = process.argv[2], bytes = fs.readFileSync(file);
const report = await validator.validateBytes(new Uint8Array(bytes));
if (report.issues.numErrors || report.issues.numWarnings)
    fail(JSON.stringify(report.issues.messages.slice(0, 5)));

const loader = new GLTFLoader().register((parser) => new VRMLoaderPlugin(parser));
const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
const meshes = [];
gltf.scene.traverse((node) => node.isSkinnedMesh && meshes.push(node));
gltf.scene.updateMatrixWorld(true);
if (meshes.length < 2) fail(`${meshes.length} skinned meshes; a body and a garment were expected`);
for (const mesh of meshes)
    if (!mesh.skeleton.bones.some((joint) => is_moved_by(mesh, joint))) fail(`no joint moves ${mesh.name}`);
const { vrm } = gltf.userData;
if (file.endsWith(".vrm")) {
    if (!vrm) fail("three-vrm does not see a VRM");
    vrm.humanoid.getNormalizedBoneNode("leftUpperArm").rotation.z = Math.PI / 2;
    vrm.update(0.1);
    gltf.scene.updateMatrixWorld(true);
    const place = (name) => vrm.humanoid.getRawBoneNode(name).getWorldPosition(new three.Vector3());
    if (place("leftHand").y - place("leftUpperArm").y < 0.2) fail("the raised left arm is not above the shoulder");
}
console.log(`${file}: ${meshes.length} skinned meshes, ${meshes[0].skeleton.bones.length} joints`
            + (vrm ? `, VRM with ${Object.keys(vrm.humanoid.humanBones).length} bones` : ""));
