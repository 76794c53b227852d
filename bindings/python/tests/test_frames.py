"""Frames: arrays over the library's memory, frames from arrays, copies into the host's memory."""

import numpy as np
import pytest

import vfit
from conftest import INTRINSICS
from vfit import Stream


def test_pixels_go_in_and_come_out(ctx, images):
    depth, users = images
    color = np.random.default_rng(1).integers(0, 256, (120, 160, 4), np.uint8)
    frame = vfit.Frame.from_numpy(ctx, depth, INTRINSICS, users=users, color=color, time_ns=42)
    assert frame.streams == (Stream.DEPTH, Stream.USER_MAP, Stream.COLOR)
    assert np.array_equal(frame.depth, depth) and frame.depth.dtype == np.uint16
    assert np.array_equal(frame.users, users)
    assert np.array_equal(frame.color, color)
    assert frame.time_ns == 42
    k = frame.intrinsics
    assert (k.fx, k.fy, k.cx, k.cy, k.width, k.height) == (120, 120, 79.5, 59.5, 160, 120)


def test_a_slice_and_a_mask_are_taken_as_they_look(ctx, images):
    depth, users = images
    frame = vfit.Frame.from_numpy(ctx, depth[::2, ::-2], INTRINSICS, users=(users == 1)[::2, ::-2])
    assert np.array_equal(frame.depth, depth[::2, ::-2])
    assert np.array_equal(frame.users, users[::2, ::-2])


def test_views_share_memory_and_are_read_only(frame):
    a, b = frame.depth, frame.view(Stream.DEPTH)
    assert a.ctypes.data == b.ctypes.data and a.ctypes.data % 16 == 0
    assert not a.flags.owndata and a.base is not None
    with pytest.raises(ValueError):
        a[0, 0] = 1
    with pytest.raises(ValueError):
        a.setflags(write=True)


def test_from_numpy_copies(ctx, images):
    depth, users = images
    frame = vfit.Frame.from_numpy(ctx, depth, INTRINSICS)
    depth[:] = 7
    assert frame.depth[0, 0] == 3000
    assert Stream.DEPTH in frame and Stream.USER_MAP not in frame
    with pytest.raises(vfit.ArgumentError, match="no stream"):
        frame.users


def test_wrong_arrays_are_refused_by_name(ctx, images):
    depth, users = images
    cases = [
        (dict(depth=depth.astype(np.float32)), "depth: wanted is uint16"),
        (dict(depth=depth[0]), r"depth: .*\(160,\)"),
        (dict(depth=depth, users=users.astype(np.int32)), "users: wanted is uint8"),
        (dict(depth=depth, users=users[:50]), "50"),
        (dict(depth=depth, color=np.zeros((120, 160, 3), np.uint8)), r"color: .*\(height, width, 4\)"),
        (dict(depth=depth, intrinsics=(1, 2)), "intrinsics"),
        (dict(depth=depth, intrinsics=(float("nan"), 120, 80, 60)), "fx|focal|finite"),
        (dict(depth=depth, intrinsics=INTRINSICS._replace(width=17)), "17"),
    ]
    for arguments, message in cases:
        arguments = {"intrinsics": INTRINSICS, **arguments}
        with pytest.raises(vfit.ArgumentError, match=message):
            vfit.Frame.from_numpy(ctx, **arguments)
    assert ctx.stats().frame_count == 0


def test_a_given_floor_makes_the_camera(ctx, images):
    tilt, height = 0.3, 1.8
    given = vfit.Camera.over((0.0, -np.cos(tilt), -np.sin(tilt)), height, depth_unit_m=0.0005)
    camera = vfit.Frame.from_numpy(ctx, images[0], INTRINSICS, camera=given).camera
    assert camera.floor_state is vfit.FloorState.GIVEN
    assert camera.height_m == pytest.approx(height) and camera.tilt_rad == pytest.approx(tilt)
    assert camera.depth_unit_m == pytest.approx(0.0005)
    below = -height * np.array(given.floor_normal)
    assert np.allclose(camera.world_from_camera @ [*below, 1], [0, 0, 0, 1], atol=1e-5)
    assert np.allclose(camera.world_from_camera[3], [0, 0, 0, 1])


def test_write_into_memory_of_the_host(frame):
    vertices = np.full((120, 160, 2), -1, np.float32)
    serial = frame.write(Stream.DEPTH, vertices[:, :, 0])
    assert np.allclose(vertices[:, :, 0], frame.depth * np.float32(0.001))
    assert (vertices[:, :, 1] == -1).all()
    assert serial == frame.serial(Stream.DEPTH) != 0
    vertices[:] = 0
    assert frame.write(Stream.DEPTH, vertices[:, :, 0], serial) == serial
    assert not vertices.any(), "a stream that the host has already is not copied again"


def test_write_refuses_what_does_not_fit(frame):
    with pytest.raises(vfit.CapacityError):
        frame.write(Stream.DEPTH, np.zeros(10, np.uint16))
    with pytest.raises(vfit.CapacityError):
        frame.write(Stream.DEPTH, np.zeros((0, 160), np.uint16))
    with pytest.raises(vfit.ArgumentError, match="read-only"):
        frame.write(Stream.DEPTH, frame.depth)
    with pytest.raises(vfit.ArgumentError, match="one stride"):
        frame.write(Stream.DEPTH, np.zeros((120, 200), np.uint16)[:, :160])
    with pytest.raises(vfit.ArgumentError, match="float64"):
        frame.write(Stream.DEPTH, np.zeros((120, 160)))
    one_place = np.lib.stride_tricks.as_strided(np.zeros(1, np.uint16), (120 * 160,), (0,))
    with pytest.raises(vfit.ArgumentError, match="one stride"):
        frame.write(Stream.DEPTH, one_place)


def test_submitted_joints_come_back_by_name_and_as_arrays(ctx, frame, standing):
    tracked = vfit.Tracker(ctx).submit(frame, standing, body_id=3)
    (body,) = tracked.bodies()
    assert body.id == 3 and not body.partly_out_of_view
    joints = body.joints
    assert set(joints) == set(standing) and len(joints) == 15
    assert joints["HEAD"] == pytest.approx((0, 1.6, -2, 1))
    assert joints[vfit.Joint.HEAD].y == pytest.approx(1.6)
    assert joints.state("HEAD") is vfit.JointState.MEASURED
    assert joints.positions.shape == (15, 3) and joints.ids.tolist() == sorted(
        vfit.Joint[n] for n in standing
    )
    assert joints.rotations.shape == (15, 4) and joints.confidence.tolist() == [1.0] * 15
    with pytest.raises(KeyError):
        joints["TAIL"]
    again = vfit.Tracker(ctx).submit(frame, joints, body_id=4)
    assert np.allclose(again.joints(4).positions, joints.positions)
    assert np.shares_memory(tracked.depth, frame.depth)


def test_bad_joints_are_refused(ctx, frame, standing):
    tracker = vfit.Tracker(ctx)
    with pytest.raises(vfit.DataError, match="LEFT_ELBOW") as caught:
        tracker.submit(frame, {**standing, "LEFT_ELBOW": (0.1, float("nan"), 0.2)})
    assert caught.value.code is vfit.ResultCode.ERROR_DATA
    with pytest.raises(vfit.ArgumentError, match="TAIL"):
        tracker.submit(frame, {"TAIL": (0, 0, 0)})
    with pytest.raises(vfit.ArgumentError, match="HEAD"):
        tracker.submit(frame, {"HEAD": (0, 0)})
    good = tracker.submit(frame, standing).joints()
    for name in ("positions", "rotations", "confidence", "states"):
        bad = vfit.Joints(good.ids, good.positions, good.confidence, good.states, good.rotations)
        setattr(bad, name, getattr(bad, name)[:3])
        with pytest.raises(vfit.ArgumentError, match=name):
            tracker.submit(frame, bad)
    with pytest.raises(vfit.ArgumentError, match="no joints"):
        tracker.submit(frame, {})
    assert tracker.update(frame).bodies() == []
