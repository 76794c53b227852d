"""Streams of training crops: processes of vfit-crops, mixed in a pool that spreads the crops of a body."""

import queue
import subprocess
import threading

import numpy as np
import torch

from network import COUNT, CROP, MIRROR

RECORD = np.dtype(
    [
        ("crop", "<i2", (CROP, CROP)),
        ("joints", "<f4", (COUNT, 3)),
        ("inside", "<f4", (COUNT,)),
        ("yaw", "<f4"),
        ("person", "<f4"),
    ]
)


def read(command, body, seed, first, count):
    """`count` samples at once."""
    data = subprocess.run(
        [command, body, str(seed), str(first), str(count)], check=True, stdout=subprocess.PIPE
    )
    return np.frombuffer(data.stdout, RECORD)


class Stream:
    """Batches without end. The pool is filled once and then renewed piece by piece: crops that come slower
    than they are used are used again (`reuse` times on average)."""

    def __init__(self, command, body, seed, first, processes, pool=16384, reuse=1):
        self.pool = np.empty(pool, RECORD)
        self.random = np.random.default_rng(seed + first)
        self.reuse, self.next, self.debt = reuse, 0, 0.0
        self.pipes = [
            subprocess.Popen(
                [command, body, str(seed), str(first + k * 10**9), str(10**9)],
                stdout=subprocess.PIPE,
                bufsize=1 << 22,
            )
            for k in range(processes)
        ]
        # A pipe holds two crops: read ahead, or training and the making of crops would wait for each other.
        self.ahead = queue.Queue(1024)
        for pipe in self.pipes:
            threading.Thread(target=self.read_ahead, args=(pipe.stdout,), daemon=True).start()
        for i in range(pool):
            self.renew()

    def read_ahead(self, source):
        while len(data := source.read(RECORD.itemsize)) == RECORD.itemsize:
            self.ahead.put(np.frombuffer(data, RECORD)[0])

    def renew(self):
        self.pool[self.next % len(self.pool)] = self.ahead.get(timeout=60)
        self.next += 1

    def batch(self, size):
        self.debt += size / self.reuse
        while self.debt >= 1:
            self.renew()
            self.debt -= 1
        return tensors(self.pool[self.random.integers(0, len(self.pool), size)], self.random)

    def close(self):
        for pipe in self.pipes:
            pipe.kill()


SIDE = 0.64  # cosine of 50 degrees


def tensors(records, random=None):
    """crop [n, 1, 128, 128], joints [n, COUNT, 3], weight [n, COUNT], away [n], person [n], side [n]. With
    `random` half are mirrored.

    A person who faces away is labelled as if they faced the sensor (left and right exchanged) and marked
    `away`: front and back look alike in depth, and so the network need not decide before it can say where
    joints are. `side` marks side views, in which either way of labelling will do.
    """
    crop = torch.from_numpy(records["crop"].astype(np.float32) / 32767.0)[:, None]
    joints, inside = torch.from_numpy(records["joints"].copy()), torch.from_numpy(records["inside"].copy())
    away = torch.from_numpy((np.cos(records["yaw"]) < 0).astype(np.float32))
    turned = away > 0
    joints[turned], inside[turned] = joints[turned][:, MIRROR], inside[turned][:, MIRROR]
    if random is not None:
        flip = torch.from_numpy(random.random(len(records)) < 0.5)
        crop[flip] = crop[flip].flip(-1)
        joints[flip] = joints[flip][:, MIRROR] * torch.tensor([-1.0, 1.0, 1.0])
        inside[flip] = inside[flip][:, MIRROR]
    person = torch.from_numpy(records["person"].copy())
    side = torch.from_numpy(np.abs(np.cos(records["yaw"])) < SIDE)
    return crop, joints, (0.25 + 0.75 * inside) * person[:, None], away, person, side
