"""Joints alone go in; poses go out. python-osc and a reader of BVH stand in for the other programs."""

import socket
import subprocess
import sys

import numpy as np
import poses
import pytest
from conftest import ROOT
from pythonosc.osc_bundle import OscBundle

import vfit

SAMPLE = ROOT / "samples" / "05_send_poses" / "send.py"
FEET = [vfit.BONE_NAMES.index(name) for name in ("leftFoot", "rightFoot")]
VIRTUAL = "virtual:motion=demo&sex=f&frames=30&seed=7"


@pytest.fixture
def udp():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        receiver.settimeout(10)
        yield receiver


def port_of(receiver):
    return receiver.getsockname()[1]


def motion_of(source):
    with vfit.Context() as ctx:
        tracker, motion = vfit.Tracker(ctx), vfit.Motion(ctx)
        return [motion.pose() for frame in ctx.open(source) if motion.step(tracker.update(frame))]


def messages_of(packet):
    bundle = OscBundle(packet)
    return [(message.address, message.params) for message in bundle]


def vmc_posed(packet):
    """Places and rotations in Unity's frame, of the bones that a VMC receiver is told."""
    told = {p[0]: p[1:] for address, p in messages_of(packet) if address == "/VMC/Ext/Bone/Pos"}
    assert list(told) == poses.NAMES
    return poses.chained([told[n][:3] for n in told], [poses.matrix(told[n][3:]) for n in told])


def check_same(got, wanted):
    """In Unity's frame, and in vfit's."""
    places, turns = wanted[0] @ poses.MIRROR_X, poses.MIRROR_X @ wanted[1] @ poses.MIRROR_X
    assert np.abs(got[0] - places).max() < 0.001
    assert max(poses.degrees_between(a, b) for a, b in zip(got[1], turns)) < 0.1


def send(receiver, *arguments):
    run = subprocess.run(
        [sys.executable, str(SAMPLE), *map(str, arguments), "--to", f"127.0.0.1:{port_of(receiver)}"],
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert run.returncode == 0 and run.stderr == "", run.stderr
    count = int(run.stdout.split()[0])
    return [receiver.recv(65536) for _ in range(count)]


def test_a_vmc_receiver_gets_every_pose_of_the_sample(udp, tmp_path):
    file = tmp_path / "motion.bvh"
    packets = send(udp, VIRTUAL, "--bvh", file)
    wanted = motion_of(VIRTUAL)
    assert len(packets) == len(wanted) == 30
    for packet, pose in zip(packets, wanted):
        check_same(vmc_posed(packet), poses.posed(pose))
        (time_s,) = next(p for address, p in messages_of(packet) if address == "/VMC/Ext/T")
        assert time_s == pytest.approx(1e-9 * (pose.time_ns - wanted[0].time_ns), abs=1e-5)
        assert ("/VMC/Ext/OK", [1]) in messages_of(packet)
    assert file.read_text().startswith("HIERARCHY\nROOT Hips\n")


def test_a_real_recording_is_sent(udp, recordings):
    source = f"{recordings[0]}?count=20"
    packets = send(udp, source)
    wanted = motion_of(source)
    assert len(packets) == len(wanted) > 10
    for packet, pose in zip(packets, wanted):
        check_same(vmc_posed(packet), poses.posed(pose))


def test_vrchat_gets_trackers_where_the_joints_are(udp):
    packets = send(udp, VIRTUAL, "--kind", "vrchat")
    at = {"1": "hips", "2": "upperChest", "3": "leftFoot", "4": "rightFoot", "5": "leftLowerLeg"}
    at |= {"6": "rightLowerLeg", "7": "leftLowerArm", "8": "rightLowerArm", "head": "head"}
    held_by = {"5": "leftUpperLeg", "6": "rightUpperLeg", "7": "leftUpperArm", "8": "rightUpperArm"}
    for packet, pose in zip(packets, motion_of(VIRTUAL)):
        places, turns = poses.posed(pose)
        told = dict(messages_of(packet))
        assert len(told) == 18
        for tracker, bone in at.items():
            place = told[f"/tracking/trackers/{tracker}/position"]
            angles = told[f"/tracking/trackers/{tracker}/rotation"]
            joint = vfit.BONE_NAMES.index(bone)
            turn = turns[vfit.BONE_NAMES.index(held_by.get(tracker, bone))]
            assert np.abs(place @ poses.MIRROR_X - places[joint]).max() < 0.001
            # Unity: about Z, then X, then Y.
            unity = poses.about("Y", angles[1]) @ poses.about("X", angles[0]) @ poses.about("Z", angles[2])
            assert poses.degrees_between(poses.MIRROR_X @ unity @ poses.MIRROR_X, turn) < 0.1


def test_a_bvh_file_shows_the_motion():
    wanted = motion_of(VIRTUAL)
    with vfit.Context() as ctx:
        file = poses.Bvh(ctx.pose_bvh(wanted, frame_time_s=1 / 30))
        assert file.names == poses.NAMES and file.parents == poses.PARENTS
        assert len(file.frames) == len(wanted)
        for frame, pose in enumerate(wanted):
            places, turns = file.posed(frame)
            own_places, own_turns = poses.posed(pose)
            assert max(poses.degrees_between(a, b) for a, b in zip(turns, own_turns)) < 0.1
            # BVH has one skeleton, that of the last pose: of the others the feet stay.
            same = slice(None) if frame + 1 == len(wanted) else FEET
            assert np.abs(places[same] / 100 - own_places[same]).max() < 0.001
        assert len(poses.Bvh(ctx.pose_bvh(wanted, frame_time_s=1 / 90)).frames) == 3 * len(wanted) - 2
        with pytest.raises(vfit.DataError, match="pose 1"):
            ctx.pose_bvh([wanted[1], wanted[0]])
        with pytest.raises(vfit.ArgumentError, match="without a pose"):
            ctx.pose_bvh([])


def test_joints_alone_move_the_stage():
    with vfit.Context() as ctx:
        tracker, by_frame, by_joints = vfit.Tracker(ctx), vfit.Motion(ctx), vfit.Motion(ctx)
        for frame in ctx.open(VIRTUAL):
            tracked = tracker.update(frame)
            body = tracked.bodies()[0]
            assert by_frame.step(tracked)
            assert by_joints.step_joints(body.joints, time_ns=frame.time_ns)
            assert np.allclose(by_frame.pose().rotations, by_joints.pose().rotations, atol=1e-6)
        assert not vfit.Motion(ctx).step_joints({"HEAD": (0, 1.6, -2)}), "a head has no trunk"
        assert vfit.Motion(ctx).step_joints(
            {"LEFT_SHOULDER": (0.2, 1.4, -2), "RIGHT_SHOULDER": (-0.2, 1.4, -2)}
        )


def test_poses_that_cannot_be_sent_are_refused():
    with vfit.Context() as ctx:
        with pytest.raises(vfit.DataError, match="offsets"):
            ctx.pose_osc(vfit.Pose())
        with pytest.raises(vfit.ArgumentError, match="kind"):
            ctx.pose_osc(motion_of(VIRTUAL)[0], "nonsense")
