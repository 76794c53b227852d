"""The tracker on numpy arrays: depth in, user map and joints out; whose joints and user map are taken."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import vfit
from conftest import INTRINSICS

SOURCE = "virtual:motion=demo&sex=f&sensor=kinect_v1_320&seed=3"


def in_camera(frame, joints):
    return frame.camera.from_world(joints.positions)


def test_a_depth_image_becomes_a_user_map_and_a_body(ctx):
    truth = next(ctx.open(SOURCE))
    tracked = vfit.Tracker(ctx).track(truth.depth, truth.intrinsics)
    (body,) = tracked.bodies()
    assert tracked.users.shape == truth.depth.shape and tracked.users.dtype == np.uint8
    found, person = tracked.users == body.id, truth.users == 1
    assert (found & person).sum() / (found | person).sum() > 0.9
    assert body.joints.positions.shape == (len(body.joints), 3) and len(body.joints) > 15
    told = truth.joints()
    errors = [
        np.linalg.norm(a - b)
        for name, a in zip(body.joints, in_camera(tracked, body.joints))
        for b in [in_camera(truth, told)[list(told).index(name)]]
    ]
    assert np.median(errors) < 0.08
    # Joints drawn into the depth image lie on the person.
    pixels = tracked.intrinsics.project(in_camera(tracked, body.joints))
    column, row = pixels[list(body.joints).index("TORSO")].round().astype(int)
    assert tracked.users[row, column] == body.id


def test_images_that_follow_each_other_keep_the_person(ctx):
    tracker, ids, height = vfit.Tracker(ctx), set(), []
    for frame in ctx.open(SOURCE, frames=12):
        tracked = tracker.track(frame.depth, tuple(frame.intrinsics)[:4], time_ns=frame.time_ns)
        assert tracked.time_ns == frame.time_ns
        ids |= {body.id for body in tracked.bodies()}
        height.append(tracked.joints()["HEAD"].y)
    assert len(ids) == 1
    assert 1.2 < height[-1] < 1.9, "world space: metres above the floor"


def carpet(frame):
    """The depth image with a rolled carpet that leans on the person's arm, with a top like a head."""
    fx, fy, cx, cy = tuple(frame.intrinsics)[:4]
    z = np.median(frame.depth[frame.users == 1]) / 1000
    feet = np.nonzero(frame.users == 1)[0].max()
    v, u = np.indices(frame.depth.shape)
    aside, height = (u - cx) / fx * z - 0.38, (feet - v) / fy * z
    depth = frame.depth.astype(float)
    depth[depth == 0] = 65535
    for radius, low, high in ((0.12, 0.02, 1.35), (0.06, 1.35, 1.6)):
        front = 1000 * (z - np.sqrt(np.maximum(radius**2 - aside**2, 0)))
        on = (np.abs(aside) < radius) & (height > low) & (height < high) & (front < depth)
        depth[on] = front[on]
    return np.where(depth == 65535, 0, depth).astype(np.uint16)


def test_two_heads_in_the_outline_are_two_people_only_where_the_network_sees_two(ctx):
    tracker = vfit.Tracker(ctx)
    source = "virtual:motion=sway&sex=f&sensor=kinect_v1_320&seed=3&distance=2.8&floor=unknown&tilt=0"
    for frame in ctx.open(source, frames=8):
        tracked = tracker.track(carpet(frame), tuple(frame.intrinsics)[:4], time_ns=frame.time_ns)
        assert [body.id for body in tracked.bodies()] == [1]
        person = tracked.users[frame.users == 1]
        assert (person == 1).mean() > 0.9


def test_a_map_of_ones_own_is_taken(ctx):
    frame = next(ctx.open(SOURCE))
    tracked = vfit.Tracker(ctx).track(
        frame.depth, frame.intrinsics, users=(frame.users == 1), camera=frame.camera
    )
    assert np.array_equal(tracked.users, frame.users)
    (body,) = tracked.bodies()
    assert body.id == 1
    assert np.allclose(tracked.camera.world_from_camera, frame.camera.world_from_camera)


def test_an_empty_room_has_nobody(ctx):
    tracked = vfit.Tracker(ctx).track(np.zeros((240, 320), np.uint16), (285, 285, 159.5, 119.5))
    assert tracked.bodies() == [] and not tracked.users.any()


def test_wrong_images_and_cameras_are_refused_by_name(ctx, images):
    tracker, depth = vfit.Tracker(ctx), images[0]
    metres = depth.astype(np.float32) / 1000
    metres[0, 0] = np.nan
    cases = [
        (metres, INTRINSICS, r"depth: wanted is uint16 \(height, width\).*float32.*metres"),
        (depth.astype(np.int16), INTRINSICS, "depth: wanted is uint16.*int16"),
        (depth[None], INTRINSICS, r"depth: .*\(1, 120, 160\)"),
        (depth[:0], INTRINSICS, "0|size"),
        (depth, (-120, 120, 80, 60), "fx|focal"),
        (depth, (0, 120, 80, 60), "fx|focal"),
        (depth, (120, float("nan"), 80, 60), "fy|focal|finite"),
        (depth, (120, 120, float("inf"), 60), "c|finite"),
        (depth, (120, 120), "intrinsics"),
        (depth, INTRINSICS._replace(width=320, height=240), "320"),
    ]
    for image, intrinsics, message in cases:
        with pytest.raises(vfit.ArgumentError, match=message):
            tracker.track(image, intrinsics)
    with pytest.raises(vfit.ArgumentError, match="depth_unit"):
        tracker.track(depth, INTRINSICS, camera=vfit.Camera(depth_unit_m=-1.0))
    assert ctx.stats().frame_count == 0


def test_whose_joints_and_map_are_taken_is_a_choice(ctx):
    frame = next(ctx.open(SOURCE))
    told = frame.joints().positions
    assert np.array_equal(vfit.Tracker(ctx).update(frame).joints().positions, told)
    assert np.array_equal(
        vfit.Tracker(ctx, joints="given", user_map="given").update(frame).joints().positions, told
    )
    found = vfit.Tracker(ctx, joints="built_in").update(frame)
    assert not np.array_equal(found.joints().positions, told)
    assert np.array_equal(found.users, frame.users)
    own = vfit.Tracker(ctx, joints="built_in", user_map="built_in").update(frame)
    assert not np.array_equal(own.users, frame.users) and len(own.bodies()) == 1
    with pytest.raises(vfit.ArgumentError, match='joints: "mine" is none of "auto", "built_in", "given"'):
        vfit.Tracker(ctx, joints="mine")
    with pytest.raises(vfit.ArgumentError, match="user_map"):
        vfit.Tracker(ctx, user_map="")
    with pytest.raises(TypeError):
        vfit.Tracker(ctx, joints=None)


def test_given_joints_that_are_not_there_are_unsupported(frame, ctx, images):
    with pytest.raises(vfit.UnsupportedError, match="no joints"):
        vfit.Tracker(ctx, joints="given").update(frame)
    bare = vfit.Frame.from_numpy(ctx, images[0], INTRINSICS)
    with pytest.raises(vfit.UnsupportedError, match="no user map"):
        vfit.Tracker(ctx, user_map="given").update(bare)


def test_points_go_to_camera_space_and_to_pixels(ctx, images):
    frame = vfit.Frame.from_numpy(
        ctx, images[0], INTRINSICS, camera=vfit.Camera.over((0.0, -np.cos(0.2), -np.sin(0.2)), 1.5)
    )
    points = np.array([(0.1, 0.9, -2.0), (-0.4, 1.6, -2.5)], np.float32)
    camera = frame.camera.from_world(points)
    back = (frame.camera.world_from_camera @ np.c_[camera, np.ones(2)].T).T[:, :3]
    assert np.allclose(back, points, atol=1e-5)
    x, y, z = camera[0]
    assert np.allclose(
        frame.intrinsics.project(camera)[0], (x / z * 120 + 79.5, y / z * 120 + 59.5), atol=1e-3
    )
    with pytest.raises(ValueError, match="world_from_camera"):
        vfit.Camera().from_world(points)


def placed(tracker, frame, standing, people):
    """The frame with people in it: id -> (to the side, closer)."""
    for body, (aside, closer) in people.items():
        joints = {name: (x + aside, y, z + closer) for name, (x, y, z) in standing.items()}
        frame = tracker.submit(frame, joints, body_id=body)
    return frame


def test_the_active_person_is_followed(ctx, images, standing):
    def frame(index):
        return vfit.Frame.from_numpy(ctx, images[0], INTRINSICS, users=images[1], time_ns=index * 33_333_333)

    people = {1: (-0.5, 0.0), 2: (0.9, 0.6)}
    for follow, wanted in (("nearest", 2), ("centred", 1), ("first", 1), ("chosen", None)):
        tracked = placed(vfit.Tracker(ctx, follow=follow), frame(1), standing, people)
        assert tracked.active_body == wanted, follow
    tracker, motion = vfit.Tracker(ctx), vfit.Motion(ctx)
    tracked = placed(tracker, frame(1), standing, people)
    assert tracked.active_state is vfit.ActiveState.BY_RULE
    assert tracked.joints()["TORSO"].x == pytest.approx(0.9)
    assert motion.step(tracked)
    tracker.choose(1)
    tracked = placed(tracker, frame(2), standing, people)
    assert (tracked.active_body, tracked.active_state) == (1, vfit.ActiveState.CHOSEN)
    tracked = placed(tracker, frame(3), standing, {2: people[2]})
    assert (tracked.active_body, tracked.active_state) == (1, vfit.ActiveState.LOST)
    assert not motion.step(tracked)
    tracker.choose(None)
    assert frame(4).active_body is None and frame(4).active_state is vfit.ActiveState.NOBODY
    with pytest.raises(vfit.ArgumentError, match="follow"):
        vfit.Tracker(ctx, follow="tallest")
    with pytest.raises(vfit.ArgumentError, match="256"):
        tracker.choose(256)


def test_submitted_joints_are_steadied_unless_wanted_raw(ctx, images, standing):
    def last_head(filter):
        tracker = vfit.Tracker(ctx, filter=filter)
        for index in range(1, 20):
            frame = vfit.Frame.from_numpy(ctx, images[0], INTRINSICS, time_ns=index * 33_333_333)
            joints = {**standing, "HEAD": (0.005 * (-1) ** index, 1.6, -2.0)}
            tracked = tracker.submit(frame, joints)
        return tracked.joints()["HEAD"].x

    assert last_head("off") == pytest.approx(-0.005)
    assert abs(last_head("auto")) < 0.004
    with pytest.raises(vfit.ArgumentError, match="filter"):
        vfit.Tracker(ctx, filter="kalman")


def test_hints_are_for_one_update(ctx):
    frame = next(ctx.open(SOURCE))
    plain = vfit.Tracker(ctx, joints="built_in").update(frame).joints()["LEFT_HAND"]
    tracker = vfit.Tracker(ctx, joints="built_in")
    at = frame.intrinsics.project(frame.camera.from_world(np.array([plain[:3]], np.float32)))[0]
    tracker.hint({"LEFT_HAND": (at[0] + 8, at[1], 0.9)})
    hinted = tracker.update(frame).joints()["LEFT_HAND"]
    assert hinted.x != plain.x
    tracker.reset()
    assert tracker.update(frame).joints()["LEFT_HAND"] == plain
    for wrong, kind, message in (
        ({"TAIL": (1, 2)}, vfit.ArgumentError, "TAIL"),
        ({"HEAD": (1,)}, vfit.ArgumentError, "HEAD"),
        ({"HEAD": (1, 2, 3)}, vfit.ArgumentError, "confidence"),
        ({vfit.Joint.HEAD: (1, float("nan"))}, vfit.DataError, "HEAD"),
    ):
        with pytest.raises(kind, match=message):
            tracker.hint(wrong)
    tracker.hint({})


def test_cameras_that_stand_around_measure_together(ctx):
    ways = (0, 90, 180, 270)
    walks = [ctx.open(f"virtual:motion=walk&seed=3&frames=40&facing={way}") for way in ways]
    points = [np.array([frame.joints()["PELVIS"][:3] for frame in walk], np.float32) for walk in walks]
    places = [vfit.align_worlds(ctx, points[0], there) for there in points]
    assert all(place.rms < 0.02 for place in places)
    assert places[1].position == pytest.approx((-2.7, 0, -2.7), abs=0.05)
    assert places[1].rotation == pytest.approx((0, -0.7071, 0, 0.7071), abs=0.01)
    with pytest.raises(vfit.DataError, match="walk about"):
        vfit.align_worlds(ctx, points[0][:1].repeat(10, 0), points[1][:1].repeat(10, 0))
    with pytest.raises(ValueError, match="shape"):
        vfit.align_worlds(ctx, points[0], points[1][:5])

    cameras = [ctx.open(f"virtual:motion=scan&seed=3&arms=42&facing={way}&frames=15") for way in ways]
    trackers = [vfit.Tracker(ctx, joints="built_in") for _ in ways]
    scan = vfit.Scan(ctx, frames=5, bare=True, tight=True, cameras=4)
    seen = None
    for frames in zip(*cameras):
        for i, (tracker, frame) in enumerate(zip(trackers, frames)):
            if seen and i:
                # Of the first camera's world in this one's.
                there = np.linalg.inv(_matrix(places[i]))
                tracker.hint_from(seen, there[:3, 3], _quaternion(there))
            tracked = tracker.update(frame)
            state = scan.add(tracked, camera=i)
            if i == 0:
                seen = tracked
        if state.complete:
            break
    assert state.complete
    assert bin(state.turn_seen).count("1") == 4
    assert scan.measure()["hip_girth_m"].observed
    with pytest.raises(vfit.ArgumentError, match="camera 4"):
        scan.add(tracked, camera=4)
    with pytest.raises(vfit.ArgumentError, match="unit"):
        trackers[0].hint_from(seen, (0, 0, 0), (0, 0, 0, 0))
    trackers[0].hint_from(seen, (0, 0, 0), body_id=9)  # no such body: no effect


def _matrix(place):
    x, y, z, w = place.rotation
    out = np.eye(4)
    out[0, 0] = out[2, 2] = w * w - y * y
    out[0, 2], out[2, 0] = 2 * y * w, -2 * y * w
    out[:3, 3] = place.position
    return out


def _quaternion(matrix):
    half = 0.5 * np.arctan2(matrix[0, 2], matrix[0, 0])
    return 0.0, np.sin(half), 0.0, np.cos(half)


def test_the_body_fit_gives_the_active_person_rotations(ctx):
    for fit, wanted in (("auto", True), ("everybody", True), ("off", False)):
        tracker = vfit.Tracker(ctx, joints="built_in", fit=fit)
        tracked = tracker.update(next(ctx.open(SOURCE)))
        assert bool(tracked.joints().rotations.any()) is wanted, fit
    with pytest.raises(vfit.ArgumentError, match="fit"):
        vfit.Tracker(ctx, fit="all")


def test_body_data_that_cannot_be_read_is_named_and_not_needed_without_the_fit(ctx, tmp_path):
    frame = next(ctx.open(SOURCE))
    depth, intrinsics = frame.depth, frame.intrinsics
    data = Path(vfit.__file__).parent / "vfit_data"
    shutil.copytree(data / "networks", tmp_path / "networks")
    with vfit.Context(data_dir=str(tmp_path)) as bare:
        with pytest.raises(vfit.FileError, match="body.bin"):
            vfit.Tracker(bare).track(depth, intrinsics)
        assert vfit.Tracker(bare, fit="off").track(depth, intrinsics).bodies()
        (tmp_path / "body.bin").write_bytes((data / "body.bin").read_bytes()[:100000])
        with vfit.Context(data_dir=str(tmp_path)) as again, pytest.raises(vfit.DataError, match="is cut"):
            vfit.Tracker(again).track(depth, intrinsics)
