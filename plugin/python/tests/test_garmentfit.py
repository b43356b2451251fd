# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions of the package."""
import json
import signal
import threading
from pathlib import Path

import numpy as np
import pytest
from conftest import QUICK

import garmentfit
from garmentfit import Cancelled, Garment, InvalidInput, Mesh, _core


@pytest.fixture(scope="session")
def dressed(body, skirt):
    return garmentfit.dress(body, skirt, frames=3, **QUICK)


def test_dressing_is_certified_and_leaves_the_body_where_it_was(dressed, body, skirt):
    assert dressed.certified and dressed.note == ""
    assert np.array_equal(dressed.body, body.positions)
    garment = dressed.garments[0]
    assert np.array_equal(garment.triangles, skirt.triangles)
    assert garment.positions.shape == skirt.positions.shape
    assert garment.certificate.clean and garment.certificate.min_distance > 0
    assert garment.certificate.kept_self_crossings == 0 and garment.overstretched.edges == 0
    assert dressed.speed >= 0 and not [warning for warning in dressed.warnings if "rest" not in warning]
    assert garment.ease.shape == garment.strain.shape == garment.pressure.shape == (len(skirt.positions),)
    assert all(girth.ease > 0 for girth in garment.girths)
    assert dressed.fits[0].type == "skirt"


def test_four_steps_give_what_dress_gives(dressed, body, skirt):
    rig = garmentfit.rig_body(body)
    assert np.allclose(rig.joint_weights.sum(axis=1), 1)
    fit = garmentfit.fit_skeleton(rig, skirt, type="skirt")
    draped = garmentfit.drape_garment(fit, settling_steps=2)
    recovered = garmentfit.recover_pose(draped, recovery_settling_steps=2, quality="draft", frames=3)
    assert np.array_equal(recovered.garments[0].positions, dressed.garments[0].positions)
    assert np.array_equal(recovered.joints, rig.joints)
    assert fit.joints.shape == rig.joints.shape and np.isfinite(fit.joints).all()


def test_frames_lead_from_the_fitted_pose_to_the_input_pose(dressed):
    shares = [frame.share for frame in dressed.frames]
    assert shares[0] == 0 and shares[-1] == 1 and shares == sorted(shares)
    assert np.array_equal(dressed.frames[-1].body, dressed.body)


def test_units_and_axes_are_those_of_the_body(body):
    metres = garmentfit.rig_body(body)
    turned = body.positions[:, [0, 2, 1]] * [100, -100, 100]  # centimetres, +z up
    centimetres = garmentfit.rig_body((turned, body.triangles), unit="cm", up="+z")
    assert centimetres.metres_per_unit == 0.01
    assert np.allclose(centimetres.joints[:, 2], 100 * metres.joints[:, 1], atol=0.1)


def test_arguments_are_not_changed_and_results_outlive_them(body):
    before = body.positions.copy()
    joints = garmentfit.rig_body(Mesh(body.positions, body.triangles)).joints
    assert np.array_equal(before, body.positions)
    assert np.isfinite(joints).all()


def test_numbers_of_the_right_type_are_not_copied(body):
    assert Mesh(body.positions, body.triangles).positions is body.positions


@pytest.mark.parametrize("call, part", [
    (lambda b, g: garmentfit.dress(b, g, density=-1), "density"),
    (lambda b, g: garmentfit.dress(b, g, colour="red"), "colour"),
    (lambda b, g: garmentfit.dress(b, Garment(g, "umbrella")), "umbrella"),
    (lambda b, g: garmentfit.rig_body(b, unit="cubit"), "cubit"),
    (lambda b, g: garmentfit.rig_body(b, height=20), "height: 20 is out of range"),
    (lambda b, g: garmentfit.rig_body(b, height="tall"), "height"),
    (lambda b, g: garmentfit.dress(b, g, garment_front="+y"), "garment_front: +y lies along the up axis"),
    (lambda b, g: garmentfit.dress(b, Garment(g, front="forwards")), "unknown axis"),
    (lambda b, g: garmentfit.dress(b, Garment(g, scale=0)), "garment_scale: 0 is out of range"),
    (lambda b, g: garmentfit.dress(b, g, as_placed="perhaps"), "as_placed"),
    (lambda b, g: garmentfit.dress(b, g, time_limit=-1), "time_limit"),
    (lambda b, g: garmentfit.rig_body(b, joints={"lknee": [1, 2]}), "lknee"),
    (lambda b, g: garmentfit.rig_body(b, joints={"tail": [1, 2, 3]}), "tail"),
    (lambda b, g: garmentfit.rig_body((b.positions[:, :2], b.triangles)), "n x 3"),
    (lambda b, g: garmentfit.rig_body((b.positions, b.triangles - 1)), "vertices from -1"),
    (lambda b, g: garmentfit.rig_body((np.full((9, 3), np.nan), b.triangles[:1] * 0)), "finite"),
    (lambda b, g: garmentfit.rig_body(42), "int is no mesh"),
    (lambda b, g: garmentfit.fit_skeleton(b, g), "give the result of rig_body"),
    (lambda b, g: garmentfit.recover_pose(None), "give the result of drape_garment"),
    (lambda b, g: garmentfit.read_mesh("nobody.ply"), "nobody.ply"),
    (lambda b, g: garmentfit.dress(b, []), "garment"),
    (lambda b, g: garmentfit.dress(b, (np.zeros((0, 3)), np.zeros((0, 3), dtype=int))), "garment"),
    (lambda b, g: garmentfit.rig_body((b.positions, b.triangles + 10**6)), "outside 0..2999"),
])
def test_bad_input_is_refused_in_one_line(call, part, body, skirt):
    with pytest.raises(InvalidInput) as refused:
        call(body, skirt)
    assert part in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("call, code", [
    (lambda b, g: garmentfit.rig_body(b, colour="red"), "unknown_name"),
    (lambda b, g: garmentfit.rig_body(b, proxy_vertices=1), "out_of_range"),
    (lambda b, g: garmentfit.rig_body((b.positions, b.triangles - 1)), "bad_index"),
    (lambda b, g: garmentfit.fit_skeleton(b, g), "missing_input"),
])
def test_bad_input_has_a_code_for_programs(call, code, body, skirt):
    with pytest.raises(InvalidInput) as refused:
        call(body, skirt)
    assert refused.value.code == code and InvalidInput("").code == "invalid_input"


def test_a_body_is_as_tall_as_it_is_said_to_be(body):
    units = np.ptp(body.positions[:, 1])
    assert np.isclose(garmentfit.rig_body(body, height=1.5).metres_per_unit, 1.5 / units)
    assert garmentfit.rig_body(body, height=None).metres_per_unit == 1


def test_garments_have_their_own_scale_front_and_place(body, skirt):
    rig = garmentfit.rig_body(body, height=1.5)
    layers = [Garment(skirt, "skirt"), Garment(skirt, "skirt", front="+x", scale=1.1),
              Garment(skirt, "skirt", as_placed=True)]
    fit = garmentfit.fit_skeleton(rig, layers, garment_front="+z", garment_scale=1.05)
    frames = [fit._scene.garment_arrays(i)["field"]["GarmentFrame"].flat[0] for i in range(3)]
    assert np.allclose(frames, [1.05, 1.1, 1.05 * rig.metres_per_unit])


def test_the_time_limit_ends_a_step(body, skirt):
    with pytest.raises(garmentfit.TimeLimitReached, match="time_limit") as reached:
        garmentfit.dress(body, skirt, time_limit=1e-9)
    assert reached.value.code == "time_limit" and isinstance(reached.value, garmentfit.SolverFailure)
    fit = garmentfit.fit_skeleton(garmentfit.rig_body(body), skirt)
    draped = garmentfit.drape_garment(fit, time_limit=1e-9)
    assert not draped.certified and not draped.too_small and "time limit" in draped.note
    assert draped.garments[0].certificate.clean


def test_figures_of_the_cloth_may_be_left_to_its_fabric():
    assert {name: default for name, default, *_ in _core.parameters_of("drape")}["density"] is None


def test_progress_is_told_and_can_stop(body):
    told = []
    garmentfit.rig_body(body, progress=lambda done, stage: told.append((done, stage)))
    assert told[0][0] == 0 and told[-1][0] == 1
    with pytest.raises(Cancelled):
        garmentfit.rig_body(body, progress=lambda done, stage: done < 0.5)
    with pytest.raises(ZeroDivisionError):
        garmentfit.rig_body(body, progress=lambda done, stage: 1 / 0)


def test_ctrl_c_raises_keyboard_interrupt(body):
    def interrupt(done, stage):
        if done > 0.3:
            signal.raise_signal(signal.SIGINT)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs begin without it
    try:
        with pytest.raises(KeyboardInterrupt):
            garmentfit.rig_body(body, progress=interrupt)
    finally:
        signal.signal(signal.SIGINT, before)


def test_other_threads_run_meanwhile(body):
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.wait(0.001):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    garmentfit.rig_body(body)
    stop.set()
    thread.join()
    assert len(ticks) > 10


def test_every_parameter_of_the_schema_is_documented():
    for function, name in ((garmentfit.rig_body, "rig"), (garmentfit.fit_skeleton, "fit"),
                           (garmentfit.drape_garment, "drape"), (garmentfit.recover_pose, "recover"),
                           (garmentfit.dress, "dress")):
        for parameter, *_ in _core.parameters_of(name):
            assert f"{parameter} = " in function.__doc__


def test_types_are_shipped():
    folder = Path(garmentfit.__file__).parent
    assert (folder / "py.typed").exists() and "class Scene" in (folder / "_core.pyi").read_text()


def test_meshes_come_back_from_files(body, skirt, tmp_path):
    skirt.write(tmp_path / "moved.ply", skirt.positions + 1)
    assert np.allclose(garmentfit.read_mesh(tmp_path / "moved.ply").positions, skirt.positions + 1)
    made = Mesh(body.positions / 3, body.triangles)
    made.write(tmp_path / "made.ply")
    back = garmentfit.read_mesh(tmp_path / "made.ply")
    assert np.array_equal(back.positions, made.positions) and np.array_equal(back.triangles, made.triangles)
    with pytest.raises(InvalidInput, match="ply"):
        made.write(tmp_path / "made.obj")
    with pytest.raises(InvalidInput):
        skirt.write(tmp_path / "nowhere" / "skirt.ply", skirt.positions)


def test_layers_say_whether_one_pose_serves_them(body, skirt):
    fit = garmentfit.fit_skeleton(garmentfit.rig_body(body), [Garment(skirt, "skirt"), Garment(skirt, "skirt")])
    assert [garment.type for garment in fit.garments] == ["skirt", "skirt"]
    assert fit.conflicts == []


def test_automatic_layer_order_sorts_by_type(body, skirt):
    coat, shirt = Garment(skirt, "coat"), Garment(skirt, "blouse")  # types say it, whatever the shape
    rig = garmentfit.rig_body(body)
    assert [fit.layer for fit in garmentfit.fit_skeleton(rig, [coat, shirt]).garments] == [0, 1]
    assert [fit.layer for fit in garmentfit.fit_skeleton(rig, [coat, shirt], layer_order="auto").garments] == [1, 0]


def _glb_json(path):
    data = path.read_bytes()
    assert data[:4] == b"glTF"
    return json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])


def test_frames_are_written_as_an_animation(dressed, body, skirt, tmp_path):
    dressed.write_animation(tmp_path / "dressing.glb", seconds=2)
    gltf = _glb_json(tmp_path / "dressing.glb")
    assert [mesh["name"] for mesh in gltf["meshes"]] == ["body", "skirt"]
    assert all(len(mesh["primitives"][0]["targets"]) == len(dressed.frames) - 1 for mesh in gltf["meshes"])
    times = gltf["accessors"][gltf["animations"][0]["samplers"][0]["input"]]
    assert times["count"] == len(dressed.frames) and times["max"][0] <= 2
    with pytest.raises(InvalidInput, match="length"):
        dressed.write_animation(tmp_path / "none.glb", seconds=0)
    fit = garmentfit.fit_skeleton(garmentfit.rig_body(body), skirt, type="skirt")
    with pytest.raises(InvalidInput, match="frames"):
        garmentfit.drape_garment(fit, settling_steps=2).write_animation(tmp_path / "none.glb")
    assert not (tmp_path / "none.glb").exists()


def test_an_outfit_is_one_skinned_file(dressed, body, tmp_path):
    dressed.write_outfit(tmp_path / "new" / "outfit.glb", bones="mixamo", hide_covered_skin=True)
    outfit = _glb_json(tmp_path / "new" / "outfit.glb")
    assert [mesh["name"] for mesh in outfit["meshes"]] == ["body", "skirt"]
    assert "mixamorig:Hips" in [node.get("name") for node in outfit["nodes"]]
    assert len(outfit["skins"]) == 1
    assert outfit["accessors"][outfit["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]["count"] == \
        len(body.positions)


def test_an_outfit_has_as_many_influences_as_asked(dressed, tmp_path):
    for influences in 4, 8:
        dressed.write_outfit(tmp_path / "outfit.glb", influences=influences)
        body, skirt = (mesh["primitives"][0]["attributes"] for mesh in _glb_json(tmp_path / "outfit.glb")["meshes"])
        assert ("JOINTS_1" in skirt, "JOINTS_1" in body) == (influences == 8, False)
    with pytest.raises(garmentfit.InvalidInput, match="1 to 8 joints"):
        dressed.write_outfit(tmp_path / "many.glb", influences=9)
    assert not (tmp_path / "many.glb").exists()


def _write_glb(path, text, rest):
    chunk = json.dumps(text).encode()
    chunk += b" " * (-len(chunk) % 4)
    body = len(chunk).to_bytes(4, "little") + b"JSON" + chunk + rest
    path.write_bytes(b"glTF" + (2).to_bytes(4, "little") + (12 + len(body)).to_bytes(4, "little") + body)


def _write_part_of_outfit(path, dressed, left_out):
    whole = path.with_name("both.glb")
    dressed.write_outfit(whole, bones="mixamo")
    text = _glb_json(whole)
    text["scenes"][0]["nodes"].remove([node.get("name") for node in text["nodes"]].index(left_out))
    data = whole.read_bytes()
    _write_glb(path, text, data[20 + int.from_bytes(data[12:16], "little"):])
    return text


def test_an_outfit_on_a_skinned_body_keeps_its_file(dressed, skirt, tmp_path):
    avatar = _write_part_of_outfit(tmp_path / "avatar.glb", dressed, left_out="skirt")

    worn = garmentfit.dress(garmentfit.read_mesh(tmp_path / "avatar.glb"), Garment(skirt, "skirt"), **QUICK)
    worn.write_outfit(tmp_path / "outfit.glb")
    outfit = _glb_json(tmp_path / "outfit.glb")
    for of_file in "nodes", "meshes", "skins":
        assert outfit[of_file][:-1] == avatar[of_file]
    worn.write_outfit(tmp_path / "other.glb", bones="smpl")
    assert "left_hip" in [node.get("name") for node in _glb_json(tmp_path / "other.glb")["nodes"]]


def test_clothes_of_an_avatar_are_left_out_of_the_body(dressed, body, skirt, tmp_path):
    dressed.write_outfit(tmp_path / "in_a_skirt.glb", bones="mixamo")
    clothed = garmentfit.read_mesh(tmp_path / "in_a_skirt.glb")
    bare = garmentfit.read_mesh(tmp_path / "in_a_skirt.glb", wears="strip")
    assert (clothed.stripped, bare.stripped) == ([], ["skirt"])
    assert len(clothed.triangles) == len(body.triangles) + len(skirt.triangles)
    assert len(bare.triangles) == len(body.triangles) and len(bare.positions) == len(clothed.positions)
    with pytest.raises(InvalidInput, match="keep or strip"):
        garmentfit.read_mesh(tmp_path / "in_a_skirt.glb", wears="nothing")

    worn = garmentfit.dress(bare, Garment(skirt, "skirt"), **QUICK)
    assert any("left out of the body: skirt" in warning for warning in worn.warnings)
    worn.write_outfit(tmp_path / "outfit.glb")
    outfit = _glb_json(tmp_path / "outfit.glb")
    faces = [sum(outfit["accessors"][part["indices"]]["count"] for part in mesh["primitives"]) // 3
             for mesh in outfit["meshes"] if mesh["name"].startswith("skirt")]
    assert sorted(faces)[0] <= 1 and sorted(faces)[1:] == [len(skirt.triangles)]


def test_a_dressed_figure_is_no_garment(dressed, body, tmp_path):
    dressed.write_outfit(tmp_path / "figure.glb", bones="mixamo")
    with pytest.raises(InvalidInput, match=r"figure.glb: shows a body in clothes \(skirt\)"):
        garmentfit.dress(body, garmentfit.read_mesh(tmp_path / "figure.glb"), **QUICK)


def test_a_skin_of_a_garments_file_is_warned_of(dressed, body, tmp_path):
    _write_part_of_outfit(tmp_path / "skinned.glb", dressed, left_out="body")

    worn = garmentfit.dress(body, garmentfit.read_mesh(tmp_path / "skinned.glb"), **QUICK)
    assert [line for line in worn.warnings if line.startswith("skinned.glb has a skin; they belong to the shape")]
    assert not [line for line in dressed.warnings if "belong to the shape" in line]


def test_an_outfit_keeps_materials_of_files(body, skirt, tmp_path):
    shape = "\n".join([f"v {x} {y} {z}" for x, y, z in skirt.positions] + ["vt .5 .5", "usemtl red"]
                      + [f"f {a}/1 {b}/1 {c}/1" for a, b, c in skirt.triangles + 1])
    (tmp_path / "red.obj").write_text("mtllib red.mtl\n" + shape)
    (tmp_path / "red.mtl").write_text("newmtl red\nKd 1 0 0\n")
    red = garmentfit.read_mesh(tmp_path / "red.obj")
    garmentfit.dress(body, red, **QUICK).write_outfit(tmp_path / "red.vrm")
    outfit = _glb_json(tmp_path / "red.vrm")
    assert "VRMC_vrm" in outfit["extensionsUsed"]
    assert "red" in [material["name"] for material in outfit["materials"]]


def test_an_outfit_needs_a_certified_result_in_the_bodys_pose(dressed, body, skirt, tmp_path):
    fit = garmentfit.fit_skeleton(garmentfit.rig_body(body), skirt)
    draped = garmentfit.drape_garment(fit, settling_steps=2)
    with pytest.raises(garmentfit.InvalidInput, match="recover the pose"):
        draped.write_outfit(tmp_path / "outfit.glb")
    with pytest.raises(garmentfit.InvalidInput, match="ends in .glb or .vrm"):
        dressed.write_outfit(tmp_path / "outfit.fbx")
    with pytest.raises(garmentfit.InvalidInput, match="one of own, garmentfit, vrm"):
        dressed.write_outfit(tmp_path / "outfit.glb", bones="biped")
    assert not list(tmp_path.iterdir())


def test_texture_coordinates_say_how_the_warp_runs(body, skirt, tmp_path):
    uvs = np.column_stack([np.arctan2(skirt.positions[:, 0], skirt.positions[:, 2]), skirt.positions[:, 1]])
    by_vertex = garmentfit.Mesh(skirt.positions, skirt.triangles, uvs=uvs)
    by_corner = garmentfit.Mesh(skirt.positions, skirt.triangles, uvs=uvs[skirt.triangles])
    assert by_vertex.corner_uvs().shape == (len(skirt.triangles), 6)
    assert np.array_equal(by_vertex.corner_uvs(), by_corner.corner_uvs())
    assert skirt.corner_uvs().shape == (0, 6)
    lines = [f"v {x} {y} {z}" for x, y, z in skirt.positions] + [f"vt {u} {v}" for u, v in uvs]
    lines += ["f " + " ".join(f"{k}/{k}" for k in corners) for corners in skirt.triangles + 1]
    (tmp_path / "skirt.obj").write_text("\n".join(lines))
    read = garmentfit.read_mesh(tmp_path / "skirt.obj").corner_uvs()
    assert np.allclose(read[:, ::2], by_vertex.corner_uvs()[:, ::2])
    rig = garmentfit.rig_body(body)
    worn = [garmentfit.drape_garment(garmentfit.fit_skeleton(rig, mesh, type="skirt"), settling_steps=2,
                                     fabric="stretch_woven").garments[0].positions for mesh in (by_vertex, by_corner, skirt)]
    assert np.array_equal(worn[0], worn[1])
    assert not np.array_equal(worn[0], worn[2])
    with pytest.raises(garmentfit.InvalidInput, match="uvs are an array of shape"):
        garmentfit.Mesh(skirt.positions, skirt.triangles, uvs=uvs[1:])
