"""The whole chain on the virtual person: scan, size, avatar, motion, cloth, buffers."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import vfit

SOURCE = "virtual:motion=demo&sex=f&frames=60&seed=7"


@pytest.fixture(scope="module")
def fitted():
    """Scan, avatar and the pose of the last frame of one pass over the source."""
    ctx = vfit.Context()
    tracker, scan, motion = vfit.Tracker(ctx), vfit.Scan(ctx, sex="f"), vfit.Motion(ctx)
    states, truth = [], None
    for frame in ctx.open(SOURCE):
        tracked = tracker.update(frame)
        truth = truth or frame.meta("measures")
        states.append(scan.add(tracked))
        assert motion.step(tracked)
    avatar = vfit.Avatar.from_scan(scan)
    motion.bind(avatar)
    yield ctx, scan, states, truth, avatar, motion
    ctx.close()


def test_the_scan_completes_and_tells_how_far_it_is(fitted):
    _, _, states, _, _, _ = fitted
    assert states[-1].complete and states[-1].frames_taken == states[-1].frames_wanted == 30
    assert any(state.taken and state.guidance is vfit.Guidance.NONE for state in states)


def test_the_fitted_body_measures_from_the_front_and_the_side():
    with vfit.Context() as ctx:
        scan = vfit.Scan(ctx, frames=6, method=vfit.ScanMethod.FIT, side_frames=5, bare=True)
        for view in ("motion=scan&frames=6", "motion=side&facing=90&frames=12"):
            with ctx.open("virtual:sensor=kinect_v1&sex=f&" + view) as sensor:
                for frame in sensor:
                    state = scan.add(frame, 1)
                    truth = frame.meta("measures")
        assert state.complete and (state.frames_taken, state.side_frames_taken) == (6, 5)
        measures = scan.measure()
        assert measures["stature_m"].value == pytest.approx(truth["stature_m"], abs=0.02)
        waist = measures["waist_girth_m"]
        assert waist.observed and abs(waist.value - truth["waist_girth_m"]) < max(0.03, 3.5 * waist.sigma)


def test_a_turn_on_the_spot_is_followed():
    with vfit.Context() as ctx:
        scan = vfit.Scan(ctx, frames=6, turn=True, bare=True, tight=True)
        for view in ("motion=scan&frames=8", "motion=round&frames=150&rate=15"):
            with ctx.open("virtual:sensor=kinect_v1&sex=f&" + view) as sensor:
                for frame in sensor:
                    state = scan.add(frame, 1)
                    if not state.complete:
                        assert state.turn_wanted == (1 << 24) - 1
        assert state.complete and bin(state.turn_seen).count("1") >= 20
        assert scan.measure()["waist_girth_m"].observed


def test_measures_come_with_sigma_and_near_the_truth(fitted):
    _, scan, _, truth, _, _ = fitted
    measures = scan.measure()
    stature = measures["stature_m"]
    assert isinstance(stature, vfit.Measurement) and stature.observed and 0 < stature.sigma < 0.1
    assert stature.value == pytest.approx(truth["stature_m"], abs=0.06)
    assert set(measures) <= set(vfit.MEASURES)
    assert all(np.isfinite(m.value) for m in measures.values())
    scale = scan.scale("short_sleeves")
    assert 0.5 < scale.x < 2 and 0.5 < scale.y < 2
    with pytest.raises(vfit.ArgumentError):
        scan.scale("cape")
    assert all(c.radius > 0 and c.joint_b is None for c in scan.colliders())


def test_sizes_are_probabilities_best_first(fitted):
    ctx, scan, _, _, _, _ = fitted
    chart = vfit.SizeChart.open(ctx, "paper")
    kind = vfit.Garment.open(ctx, "sundress").info.garment_kind
    sizes = chart.recommend(kind, scan.measure())
    assert {label for label, _ in sizes} == {row.label for row in chart.rows() if row.garment_kind == kind}
    chances = [size.probability for size in sizes]
    assert sum(chances) == pytest.approx(1, abs=1e-4) and chances == sorted(chances, reverse=True)
    plain = {key: m.value for key, m in scan.measure().items()}
    assert {s.label for s in chart.recommend(kind, plain)} == {s.label for s in sizes}
    with pytest.raises(vfit.DataError, match="chest_girth_m"):
        vfit.SizeChart.open(ctx, "en13402_women").recommend(kind, {"stature_m": 1.7})


def test_a_size_sits_somehow_in_each_zone(fitted):
    ctx, _, _, _, _, _ = fitted
    chart = vfit.SizeChart.open(ctx, "en13402_women")
    measures = {"chest_girth_m": (0.92, 0.01), "waist_girth_m": (0.9, 0.01), "hip_girth_m": 1.02}
    zones = {zone.key: zone for zone in chart.zones("dress", "M", measures)}
    assert set(zones) == set(measures)
    assert zones["chest_girth_m"].regular > 0.9 and zones["waist_girth_m"].tight > 0.9
    assert zones["waist_girth_m"].ease == pytest.approx(0.78 - 0.9, abs=1e-6)
    with pytest.raises(vfit.ArgumentError, match="XXXS"):
        chart.zones("dress", "XXXS", measures)


def test_measures_of_ones_own(fitted):
    _, _, _, _, avatar, _ = fitted
    own = json.dumps(
        {
            "format": "vfit-own-measures",
            "version": 1,
            "measures": [
                {
                    "key": "x_calf_girth_m",
                    "girth": {"at": ["LEFT_KNEE", "LEFT_FOOT", 0.3], "square_to": ["LEFT_KNEE", "LEFT_FOOT"]},
                }
            ],
        }
    )
    assert 0.2 < avatar.measure_own(own)["x_calf_girth_m"].value < 0.5
    with pytest.raises(vfit.DataError, match="format"):
        avatar.measure_own("{}")


def test_measurements_are_kept_as_text_and_merged():
    measures = {
        "stature_m": vfit.Measurement(1.7, 0.01, True),
        "waist_girth_m": vfit.Measurement(0.8, 0.02, False),
    }
    text = vfit.write_measurements(measures, "f")
    again, sex = vfit.read_measurements(text)
    assert sex == vfit.Sex.FEMALE and again["waist_girth_m"].observed is False
    assert again["stature_m"].value == pytest.approx(1.7)
    merged = vfit.merge_measurements(again, {"stature_m": (1.71, 0.01), "hip_girth_m": 1.0})
    assert merged["stature_m"].value == pytest.approx(1.705) and set(merged) == {
        "stature_m",
        "waist_girth_m",
        "hip_girth_m",
    }
    with pytest.raises(vfit.DataError, match="two people"):
        vfit.merge_measurements(again, {"stature_m": (1.9, 0.01)})
    with pytest.raises(vfit.DataError, match="JSON"):
        vfit.read_measurements("{")


def test_all_measures_follow_from_those_that_a_person_knows(ctx):
    assert "adults" in ctx.populations()
    adults = vfit.Population.open(ctx, "adults")
    known = {"stature_m": 1.7, "body_mass_kg": 65.0}
    all_measures = adults.estimate(known, sex="f", age=40)
    assert 0.9 < all_measures["hip_girth_m"].value < 1.1
    assert all_measures["stature_m"].observed and not all_measures["hip_girth_m"].observed
    assert adults.check(known, sex="f") == []
    (doubt,) = adults.check({**known, "waist_girth_m": 0.30, "hip_girth_m": 1.0}, sex="f")
    assert (doubt.key, doubt.kind) == ("waist_girth_m", vfit.DoubtKind.INCHES)
    assert doubt.suggested == pytest.approx(0.762, abs=0.001)
    with pytest.raises(vfit.ArgumentError):
        adults.estimate(known, age=7)
    with pytest.raises(vfit.DataError):
        vfit.Population.load(ctx, "{}")


def test_scans_are_calibrated_to_a_tape():
    text = None
    for i in range(40):
        tape = {"waist_girth_m": 0.82 + 0.001 * (i % 5), "hip_girth_m": 1.0}
        text = vfit.add_to_calibration(text, {"waist_girth_m": (0.8, 0.01)}, tape)
    told = vfit.calibrated_measures(text)
    assert set(told) == {"waist_girth_m"}
    assert told["waist_girth_m"].people == 40 and told["waist_girth_m"].enough
    scan = vfit.calibrate(text, {"waist_girth_m": (0.9, 0.01), "stature_m": (1.7, 0.01)})
    assert scan["waist_girth_m"].value == pytest.approx(0.922, abs=0.001)
    assert scan["waist_girth_m"].sigma < 0.005 and scan["stature_m"].sigma == pytest.approx(0.01)
    with pytest.raises(vfit.DataError, match="sigma"):
        vfit.add_to_calibration(None, {"waist_girth_m": 0.8}, {"waist_girth_m": 0.8})


def test_the_pose_is_arrays_and_can_be_given_back(fitted):
    _, _, _, _, avatar, motion = fitted
    pose = motion.pose()
    assert pose.rotations.shape == (22, 4) and pose.positions.shape == (22, 3)
    assert np.allclose(np.linalg.norm(pose.rotations, axis=1), 1, atol=1e-3)
    assert set(pose.as_dict()) == set(vfit.BONE_NAMES)
    assert motion.joints()["HEAD"].y > motion.joints()["LEFT_FOOT"].y
    avatar.pose(pose)
    moved = avatar.acquire().positions.copy()
    pose.positions[vfit.Bone.HIPS] += (1, 0, 0)
    avatar.pose(pose)
    assert np.allclose(avatar.acquire().positions - moved, (1, 0, 0), atol=1e-3)
    with pytest.raises(vfit.ArgumentError, match="22"):
        avatar.pose(vfit.Pose(rotations=np.zeros((3, 4), np.float32)))
    with pytest.raises(vfit.DataError):
        avatar.pose(vfit.Pose(rotations=np.full((22, 4), np.nan, np.float32)))
    avatar.pose(vfit.Pose())


def test_the_avatar_is_a_skinned_mesh(fitted):
    _, _, _, _, avatar, _ = fitted
    rest, posed, rig = avatar.acquire_rest(), avatar.acquire(), avatar.rig()
    n = len(rest.positions)
    assert rest.positions.shape == rest.normals.shape == (n, 3) and rest.uvs.shape == (n, 2)
    assert rest.triangles.shape[1] == 3 and rest.triangles.max() < n
    assert rest.skin_bones.shape == rest.skin_weights.shape == (n, 8)
    assert np.allclose(rest.skin_weights.sum(axis=1), 1, atol=1e-4)
    matrices = posed.bone_matrices
    assert matrices.shape == (len(rig), 4, 4) and np.allclose(matrices[:, 3], [0, 0, 0, 1])
    assert rig[0].parent == -1 and {b.bone for b in rig} >= set(vfit.Bone)
    # Skinned here from the same frame: the matrices' rows and columns are the right way round.
    homogeneous = np.c_[rest.positions, np.ones(n, np.float32)]
    skinned = np.einsum("nk,nkij,nj->ni", rest.skin_weights, matrices[rest.skin_bones], homogeneous)[:, :3]
    # Creases that open for cloth move the skin at armpits and the like.
    off = np.abs(skinned - posed.positions).max(axis=1)
    assert np.quantile(off, 0.9) < 2e-3 and off.max() < 0.1
    assert avatar.measure()["stature_m"].value > 1
    assert any(c.joint_b is not None for c in avatar.colliders()) or avatar.colliders()
    assert avatar.joints()["HEAD"].y > 0


def test_cloth_hangs_on_the_avatar(fitted):
    ctx, _, _, _, avatar, motion = fitted
    avatar.pose(motion.pose())
    garment = vfit.Garment.open(ctx, "sundress")
    info = garment.info
    assert info.garment_kind and info.vertex_count >= info.simulated_count > 0
    cloth = vfit.Cloth(avatar, garment)
    start = cloth.state_hash()
    for _ in range(10):
        cloth.step()
    cloth.begin_step(1 / 60)
    with pytest.raises(vfit.StateError):
        cloth.begin_step()
    cloth.end_step()
    hash_of_step = cloth.state_hash()
    assert hash_of_step != start
    stepped = cloth.acquire().positions.copy()
    cloth.carry()
    assert cloth.state_hash() == hash_of_step and np.allclose(cloth.acquire().positions, stepped, atol=1e-5)
    frame = cloth.acquire()
    for array in (frame.positions, frame.normals, frame.uvs, frame.strain):
        assert len(array) == info.vertex_count and np.isfinite(array).all()
    assert frame.triangles.max() < info.vertex_count
    assert cloth.stats().step_ms > 0 and np.isfinite(cloth.stats().strain_max)
    body = avatar.acquire().positions
    assert (frame.positions.min(0) > body.min(0) - 0.5).all() and (
        frame.positions.max(0) < body.max(0) + 0.5
    ).all()
    buffer = np.zeros((info.vertex_count, 8), np.float32)
    frame.write(vfit.Stream.POSITION, buffer[:, :3])
    frame.write(vfit.Stream.NORMAL, buffer[:, 3:6])
    assert np.array_equal(buffer[:, :3], frame.positions) and np.array_equal(buffer[:, 3:6], frame.normals)
    assert not buffer[:, 6:].any()
    short = np.zeros(frame.triangles.size, np.uint16)
    if info.vertex_count <= 65535:
        frame.write(vfit.Stream.INDEX, short)
        assert np.array_equal(short.reshape(-1, 3), frame.triangles)


def test_hands_may_be_let_through(ctx):
    def settled(hands):
        avatar = vfit.Avatar.from_measures(ctx, {"stature_m": 1.68}, sex="f", limbs_as_posed=True)
        pose = vfit.Pose()
        pose.positions[vfit.Bone.HIPS] = avatar.joints()["PELVIS"][:3]
        for bone, turn in ((vfit.Bone.LEFT_UPPER_ARM, -1.5), (vfit.Bone.RIGHT_UPPER_ARM, 1.5)):
            pose.rotations[bone] = (0, 0, np.sin(turn / 2), np.cos(turn / 2))
        avatar.pose(pose)
        cloth = vfit.Cloth(avatar, vfit.Garment.open(ctx, "sundress"), hands=hands)
        for _ in range(5):
            cloth.step()
        return cloth.state_hash()

    assert settled(True) == settled(True) != settled(False)


def test_equal_contexts_make_equal_cloth():
    hashes = []
    for workers in (1, 2):
        with vfit.Context(deterministic=True, workers=workers) as ctx:
            cloth = vfit.Cloth(
                vfit.Avatar.from_measures(ctx, {"stature_m": 1.68}, sex="f"),
                vfit.Garment.open(ctx, "sundress"),
            )
            for _ in range(5):
                cloth.step()
            hashes.append(cloth.state_hash())
    assert hashes[0] == hashes[1]


def test_what_a_cloth_may_be_told(ctx):
    avatar = vfit.Avatar.from_measures(ctx, {"stature_m": 1.68}, sex="f")
    garment = vfit.Garment.open(ctx, "sundress")
    cloths = [
        vfit.Cloth(avatar, garment, **options)
        for options in (
            {},
            {"cover_m": 0.02},
            {"skin": True, "pressure": True},
            {"virtual_m": 0.01, "self_thickness_m": 0.005},
        )
    ]
    for cloth in cloths:
        cloth.step()
    own, more, none, same = (cloth.stats().collider_count for cloth in cloths)
    assert own == same == 31 and more > 31 and none == 0
    assert (cloths[2].acquire().pressure >= 0).all()
    for bad in ({"cover_m": -1.0}, {"virtual_m": float("nan")}, {"cover_m": 0.01, "skin": True}):
        with pytest.raises(vfit.ArgumentError):
            vfit.Cloth(avatar, garment, **bad)


def test_a_garment_keeps_its_lengths_and_tells_how_it_sits(ctx):
    avatar = vfit.Avatar.from_shape(ctx, sex="f")
    dress = vfit.Garment.open(ctx, "sundress_pattern")
    assert [p.first_index for p in dress.parts][0] == 0 and all(0.0 <= c <= 1.0 for c in dress.parts[0].color)
    cloth = vfit.Cloth(avatar, dress, size="S", skin=True)
    for _ in range(20):
        cloth.step()
    chest = {zone.key: zone for zone in cloth.fit()}["chest_girth_m"]
    assert chest.fit == "right" and chest.ease_m == pytest.approx(chest.garment_m - chest.body_m)
    cloth.set_size("XXL")
    assert {zone.key: zone for zone in cloth.fit()}["chest_girth_m"].garment_m > chest.garment_m + 0.2
    assert cloth.fit_map().shape == (cloth.acquire().positions.shape[0],)
    with pytest.raises(vfit.ArgumentError, match="QQ"):
        cloth.set_size("QQ")
    heavy = vfit.Avatar.from_shape(ctx, {"weight": 1.15}, sex="f")
    with pytest.raises(vfit.NotWearableError, match="hip_girth_m"):
        vfit.Cloth(heavy, vfit.Garment.open(ctx, "jeans_women"), size="XS")
    assert (
        vfit.Cloth(heavy, vfit.Garment.open(ctx, "jeans_women"), size="XS", any_fit=True).stats().vertex_count
        > 0
    )


def test_hidden_skin_adds_up_over_garments(ctx):
    avatar = vfit.Avatar.from_measures(ctx, {"stature_m": 1.68}, sex="f")
    cloth = vfit.Cloth(avatar, vfit.Garment.open(ctx, "sundress"))
    body = avatar.acquire_rest()
    hidden = cloth.hide_skin()
    assert hidden.dtype == bool and hidden.shape == (len(body.triangles),) and 0.02 < hidden.mean() < 0.5
    assert cloth.hide_skin(margin_m=0.1).sum() < hidden.sum()
    before = np.zeros_like(hidden)
    before[:100] = True
    both = cloth.hide_skin(hidden=before)
    assert np.array_equal(both, hidden | before)
    with pytest.raises(vfit.ArgumentError):
        cloth.hide_skin(hidden=before[:7])
    # What is hidden is of the trunk and the thighs.
    heights = body.positions[body.triangles[hidden]][..., 1]
    assert heights.max() < 0.85 * body.positions[:, 1].max()


def test_an_outfit_is_tested_for_crossings(ctx):
    avatar = vfit.Avatar.from_shape(ctx, sex="f")
    dress = vfit.Garment.open(ctx, "sundress")
    inner, outer = (vfit.Cloth(avatar, dress, skin=True) for _ in range(2))
    for cloth in inner, outer:
        cloth.step()
    found = {(c.kind, c.cloth, c.other): c for c in vfit.outfit_check([inner, outer])}
    twice = found["cloth", 0, 1]
    triangles = len(outer.acquire().triangles)
    assert twice.pair_count > 100 and twice.triangle < triangles and twice.other_triangle < triangles
    assert ("cloth", 0, 1) not in {(c.kind, c.cloth, c.other) for c in vfit.outfit_check([inner])}
    for bad in [], [inner, inner]:
        for call in vfit.outfit_check, vfit.outfit_skin:
            with pytest.raises(vfit.ArgumentError):
                call(bad)


def test_skin_below_an_outfit_is_the_avatars_mesh(ctx):
    avatar = vfit.Avatar.from_shape(ctx, sex="f")
    cloth = vfit.Cloth(avatar, vfit.Garment.open(ctx, "sundress"), skin=True)
    cloth.step()
    skin, crossing = vfit.outfit_skin([cloth])
    own = avatar.acquire()
    assert crossing == 0
    assert np.array_equal(skin.triangles, own.triangles)
    assert skin.positions.shape == own.positions.shape
    assert np.abs(skin.positions - own.positions).max() <= 0.021


def test_cloth_stays_outside_of_props(ctx):
    avatar = vfit.Avatar.from_shape(ctx, sex="f")
    cloth = vfit.Cloth(avatar, vfit.Garment.open(ctx, "sundress"), sleeps=False)

    def hem_reaches():
        positions = cloth.acquire().positions
        return positions[(positions[:, 1] > 0.45) & (positions[:, 1] < 0.65), 0].max()

    for _ in range(30):
        cloth.step()
    free = hem_reaches()
    corners = 0.1 * (np.stack(np.meshgrid(*[[-1, 1]] * 3), -1).reshape(-1, 3))
    hull = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]]
    hull += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    p, q, r = corners[hull].transpose(1, 0, 2)
    inward = np.einsum("ni,ni->n", np.cross(q - p, r - p), p + q + r) < 0
    hull = np.array([t[::-1] if turn else t for t, turn in zip(hull, inward)])
    ball, box = vfit.Prop.sphere(ctx, 0.11), vfit.Prop.mesh(ctx, corners, hull)
    for prop in ball, box, vfit.Prop.capsule(ctx, 0.02, 0.3), vfit.Prop.box(ctx, (0.1, 0.1, 0.1)):
        prop.move((5.0, 0.0, 0.0))
        cloth.add_prop(prop)
    for i in range(60):
        ball.move((free + 0.3 - 0.005 * i, 0.55, 0.0))
        cloth.step()
        assert all(c.kind != "prop" for c in vfit.outfit_check([cloth]))
    pushed = hem_reaches()
    assert pushed < free - 0.02
    cloth.remove_prop(ball)
    box.deform(2.0 * corners)
    for _ in range(60):
        cloth.step()
    assert hem_reaches() > pushed + 0.02
    with pytest.raises(vfit.DataError, match="clockwise"):
        vfit.Prop.mesh(ctx, corners, hull[:, ::-1])
    for call in cloth.add_prop, cloth.remove_prop:
        with pytest.raises(TypeError):
            call(None)
    with pytest.raises(ValueError, match="shape"):
        vfit.Prop.mesh(ctx, corners.ravel(), hull)
    with pytest.raises(vfit.ArgumentError):
        box.deform(corners[:5])
    box.close()
    cloth.step()
    with pytest.raises(vfit.HandleError):
        cloth.add_prop(box)


def test_a_cloth_goes_with_its_avatar(ctx):
    avatar = vfit.Avatar.from_shape(ctx, {"weight": 0.6}, sex="m")
    assert "weight" in ctx.shape_values()
    cloth = vfit.Cloth(avatar, vfit.Garment.open(ctx, "sundress"))
    avatar.close()
    with pytest.raises(vfit.HandleError):
        cloth.step()
    cloth.close()
    assert cloth.closed


def test_unity_axes_are_left_handed_with_the_same_outside():
    with vfit.Context() as right, vfit.Context(axes=vfit.Axes.UNITY) as left:
        a, b = (vfit.Avatar.from_measures(c, {"stature_m": 1.7}).acquire_rest() for c in (right, left))
    signs = np.sign((a.positions * b.positions).sum(axis=0))
    assert signs.prod() == -1, "one axis is turned round"
    assert np.allclose(a.positions * signs, b.positions)
    # The winding is reversed with it, so that cross products still point where the normals do.
    for frame in (a, b):
        p, q, r = (frame.positions[frame.triangles[:, corner]] for corner in range(3))
        outward = np.einsum("ni,ni->n", np.cross(q - p, r - p), frame.normals[frame.triangles[:, 0]])
        assert (outward > 0).mean() > 0.95


def test_poses_and_bodies_go_over_the_network(fitted):
    ctx, _, _, _, avatar, motion = fitted
    pose = motion.pose()
    packet = ctx.pack_pose(pose)
    assert len(packet) <= 120
    back = ctx.unpack_pose(packet)
    assert back.time_ns == pose.time_ns and back.contacts == pose.contacts
    assert np.abs(np.sum(back.rotations * pose.rotations, axis=1)).min() > 0.99999
    assert np.allclose(back.positions[0], pose.positions[0], atol=1e-3)
    body = avatar.pack("M")
    assert len(body) <= 240
    other, label = vfit.Avatar.unpack(ctx, body)
    assert label == "M"
    assert other.measure()["waist_girth_m"].value == pytest.approx(
        avatar.measure()["waist_girth_m"].value, abs=2e-3
    )
    with pytest.raises(vfit.DataError):
        ctx.unpack_pose(packet[:50])
    with pytest.raises(vfit.VersionError):
        vfit.Avatar.unpack(ctx, b"\x09" + body[1:])


def test_the_skin_goes_into_arrays_of_ones_own(fitted):
    _, _, _, _, avatar, motion = fitted
    avatar.pose(motion.pose())
    frame = avatar.acquire()
    vertices = np.zeros(len(frame.positions), dtype=[("position", "3f4"), ("normal", "3f4"), ("uv", "2f4")])
    avatar.pose_into(motion.pose(), vertices["position"], vertices["normal"])
    assert np.array_equal(vertices["position"], frame.positions) and np.array_equal(
        vertices["normal"], frame.normals
    )
    assert not vertices["uv"].any()
    with pytest.raises(vfit.CapacityError):
        avatar.pose_into(motion.pose(), vertices["position"][:100])


def test_a_character_of_ones_own_is_loaded(fitted, tmp_path):
    ctx, _, _, _, avatar, motion = fitted
    assert avatar.describe().kind == "body" and avatar.parts()[0].material_index is None
    nobody = tmp_path / "nobody.gltf"
    nobody.write_text('{"asset": {"version": "2.0"}}')
    with pytest.raises(vfit.DataError, match="skinned"):
        vfit.Avatar.load(ctx, nobody)
    with pytest.raises(vfit.FileError, match="missing.vrm"):
        vfit.Avatar.load(ctx, tmp_path / "missing.vrm")
    with pytest.raises(vfit.DataError):
        vfit.Avatar.load(ctx, b"glTF but no more than that")
    program = Path(os.environ.get("VFIT_BUILD_DIR", "build")) / "bin" / "vfit"
    if not program.exists():
        pytest.skip("no vfit command line to write a character with")
    vrm = tmp_path / "body.vrm"
    subprocess.run([program, "character", "--rig", "vrm1", "--out", vrm], check=True)
    with vfit.Avatar.load(ctx, vrm, bone_map={"head": "head"}) as character:
        about = character.describe()
        assert about.kind == "vrm1" and about.name == "vfit body" and about.from_file.shape == (4, 4)
        assert {b.name for b in character.rig() if b.node is not None} >= {"hips", "head", "leftHand"}
        other = vfit.Motion(ctx)
        other.bind(character)
        character.pose(motion.pose())
        assert np.isfinite(character.acquire().positions).all()
