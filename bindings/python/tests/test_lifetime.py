"""Who keeps what alive: arrays outlive frames, sensors and contexts, and nothing is left behind."""

import gc
import signal
import subprocess
import sys
import threading
import weakref

import numpy as np
import pytest

import vfit
from conftest import INTRINSICS

VIRTUAL = "virtual:motion=demo&sex=f&frames=60"


def test_an_array_outlives_frame_sensor_and_context():
    ctx = vfit.Context()
    sensor = ctx.open(VIRTUAL)
    frame = next(sensor)
    depth = frame.depth
    before = depth.copy()
    assert before.any()
    gone = weakref.ref(frame)
    del frame
    assert gone() is None, "the array needs no Frame object"
    for _ in range(5):
        next(sensor)
    sensor.close()
    ctx.close()
    del sensor, ctx
    gc.collect()
    assert np.array_equal(depth, before)


def test_closing_a_frame_leaves_its_arrays(ctx, images):
    depth, users = images
    with vfit.Frame.from_numpy(ctx, depth, INTRINSICS) as frame:
        view = frame.depth
    assert frame.closed and ctx.stats().frame_count == 1
    with pytest.raises(vfit.HandleError, match="released"):
        frame.depth
    # Were the memory back in the pool, the next frame would write over it.
    others = [vfit.Frame.from_numpy(ctx, np.full_like(depth, 9), INTRINSICS) for _ in range(8)]
    assert np.array_equal(view, depth)
    del view, others
    assert ctx.stats().frame_count == 0


def test_the_last_array_frees_the_context():
    ctx = vfit.Context()
    view = vfit.Frame.from_numpy(ctx, np.zeros((4, 4), np.uint16), (4.0, 4.0, 2.0, 2.0)).depth
    ctx.close()
    assert ctx.closed and ctx.stats().frame_count == 1
    del view
    assert ctx.stats().frame_count == 0


def test_closing_the_context_closes_its_objects(frame, ctx):
    objects = [ctx.open(VIRTUAL), vfit.Tracker(ctx), vfit.Scan(ctx), vfit.Motion(ctx)]
    ctx.close()
    ctx.close()
    assert all(object_.closed for object_ in objects)
    with pytest.raises(vfit.HandleError, match="closed"):
        next(objects[0])
    with pytest.raises(vfit.HandleError, match="closed"):
        vfit.Scan(ctx)
    assert frame.depth.shape == (120, 160)


def test_objects_keep_their_context():
    sensor = vfit.Context().open(VIRTUAL)
    gc.collect()
    assert next(sensor).depth.any()


def test_two_hundred_acquires_leave_nothing_behind(ctx):
    avatar = vfit.Avatar.from_measures(ctx, {"stature_m": 1.7}, sex="f")
    for _ in range(200):
        frame = avatar.acquire()
        positions, matrices = frame.positions, frame.bone_matrices
        assert ctx.stats().frame_count == 1
        del frame
        assert np.isfinite(positions).all() and np.isfinite(matrices).all()
        del positions, matrices
    assert ctx.stats().frame_count == 0


def test_contexts_do_not_grow_the_process():
    resource = pytest.importorskip("resource")

    def cycle(count):
        for _ in range(count):
            with vfit.Context() as ctx:
                for frame in ctx.open("virtual:motion=scan&frames=3"):
                    frame.depth.sum()
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    settled = cycle(6)
    grown_kib = cycle(12) - settled
    assert grown_kib < 20 * 1024, f"{grown_kib} KiB more after 12 contexts"


def test_another_thread_runs_while_one_waits(ctx, images):
    sensor = ctx.open("virtual:motion=scan", pace="realtime", rate=1)
    sensor.start()
    sensor.acquire()
    ticks, done = 0, threading.Event()

    def wait():
        sensor.acquire(timeout_s=2.0)
        done.set()

    thread = threading.Thread(target=wait)
    thread.start()
    while not done.wait(0.001):
        ticks += 1
    thread.join()
    assert ticks > 50, "the wait held the interpreter lock"


def test_closing_wakes_a_thread_that_waits(ctx):
    sensor = ctx.open("virtual:motion=scan", pace="realtime", rate=1)
    sensor.start()
    sensor.acquire()
    sensor.acquire()
    caught = []

    def wait():
        try:
            while True:
                sensor.acquire()
        except vfit.Error as error:
            caught.append(error)

    thread = threading.Thread(target=wait)
    thread.start()
    sensor.close()
    thread.join(timeout=10)
    assert not thread.is_alive() and isinstance(caught[0], (vfit.HandleError, vfit.StateError))


@pytest.mark.parametrize("end", ["pass", "raise SystemExit(0)", "ctx.close()", "del ctx"])
def test_the_process_ends_cleanly_in_mid_stream(end):
    script = "\n".join(
        [
            "import vfit",
            "ctx = vfit.Context()",
            f"sensor = ctx.open({VIRTUAL!r})",
            "kept = next(sensor).depth",
            end,
            "",
        ]
    )
    run = subprocess.run(
        [sys.executable, "-X", "faulthandler", "-c", script], capture_output=True, text=True, timeout=60
    )
    assert run.returncode == 0 and run.stderr == ""


def test_holding_too_many_frames_is_an_error_not_a_hang(ctx):
    sensor = ctx.open(VIRTUAL)
    with pytest.raises(vfit.BusyError, match="copy"):
        list(sensor)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no interval timers here")
def test_a_signal_gets_through_while_a_frame_is_awaited(ctx):
    class Interrupted(Exception):
        pass

    def interrupt(number, stack):
        raise Interrupted

    sensor = ctx.open("virtual:motion=scan", pace="realtime", rate=1)
    sensor.start()
    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    try:
        with pytest.raises(Interrupted):
            while True:
                sensor.acquire()
    finally:
        signal.signal(signal.SIGALRM, before)
