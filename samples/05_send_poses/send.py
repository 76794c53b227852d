"""Sends a person's motion to another program by UDP: camera or recording, tracker, motion, packets.

python send.py [RECORDING or sensor URI] [--to HOST:PORT] [--kind vmc|vrchat] [--bvh FILE]
"""

import argparse
import pathlib
import socket
import time

import vfit

parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("source", nargs="?", default="virtual:motion=demo&sex=f&frames=60&seed=7")
parser.add_argument("--to", help="HOST:PORT; 127.0.0.1 with 39539 for VMC and 9000 for VRChat")
parser.add_argument("--kind", choices=("vmc", "vrchat"), default="vmc")
parser.add_argument("--bvh", type=pathlib.Path, help="write the motion to this file, too")
options = parser.parse_args()
address = options.to or {"vmc": "127.0.0.1:39539", "vrchat": "127.0.0.1:9000"}[options.kind]
host, _, port = address.rpartition(":")

with vfit.Context() as ctx, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
    tracker, motion = vfit.Tracker(ctx), vfit.Motion(ctx)
    poses: "list[vfit.Pose]" = []
    first_ns, start = 0, 0.0
    for frame in ctx.open(options.source):
        if not motion.step(tracker.update(frame)):
            continue  # no person in view: the receiver's avatar keeps its pose
        pose = motion.pose()
        if not poses:
            first_ns, start = pose.time_ns, time.monotonic()
        pose.time_ns -= first_ns
        poses.append(pose)
        # A camera sets the pace itself; a recording would be through in a moment.
        time.sleep(max(0.0, start + 1e-9 * pose.time_ns - time.monotonic()))
        udp.sendto(ctx.pose_osc(pose, options.kind), (host, int(port)))
    print(f"{len(poses)} poses sent to {address}")
    if options.bvh and poses:
        options.bvh.write_text(ctx.pose_bvh(poses))
        print(f"written: {options.bvh}")
