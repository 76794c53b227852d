"""Recordings: iterated, written and read again."""

import itertools

import numpy as np
import pytest

import vfit


def test_a_real_recording_is_iterated_to_its_end(ctx, recordings):
    folder = recordings[0]
    wanted = len(list((folder / "depth").glob("*.png")))
    sensor = ctx.open(folder)
    times, indices = [], []
    for frame in sensor:
        assert frame.depth.shape == (frame.intrinsics.height, frame.intrinsics.width)
        times.append(frame.time_ns)
        indices.append(frame.meta("index"))
    assert len(times) == wanted and sensor.ended
    assert all(a < b for a, b in itertools.pairwise(times))
    assert indices == list(range(wanted))
    assert sensor.acquire(timeout_s=0) is None
    stats = sensor.stats()
    assert stats.taken == wanted and stats.dropped == 0


def test_every_real_recording_is_measured(ctx, recordings):
    fitted = 0
    for folder in recordings:
        tracker, scan = vfit.Tracker(ctx), vfit.Scan(ctx, frames=5)
        paper = vfit.Scan(ctx, frames=5, method=vfit.ScanMethod.PROPORTIONS)
        for frame in ctx.open(f"recording:{folder}"):
            tracked = tracker.update(frame)
            state, complete = scan.add(tracked), paper.add(tracked).complete
            if state.complete and complete:
                break
        told = paper.measure()["stature_m"].value
        assert 1.2 < told < 2.2, folder.name
        if state.frames_taken:  # the fitted body wants arms that are clear of the body
            fitted += 1
            assert scan.measure()["stature_m"].value == pytest.approx(told, abs=0.08), folder.name
        else:
            with pytest.raises(vfit.StateError):
                scan.measure()
    assert fitted >= len(recordings) - 1


def test_what_is_recorded_is_played(ctx, tmp_path):
    depth, joints = [], []
    with vfit.Recorder(ctx, tmp_path / "out", sensor_name="virtual") as recorder:
        for frame in ctx.open("virtual:motion=demo&frames=5"):
            recorder.write(frame)
            depth.append(frame.depth.copy())
            joints.append(frame.joints())
    played = 0
    for frame in ctx.open(tmp_path / "out"):
        assert np.array_equal(frame.depth, depth[played])
        assert set(frame.joints()) == set(joints[played])
        played += 1
    assert played == 5


def test_a_source_takes_options_in_its_uri(ctx, tmp_path):
    folder = tmp_path / "out"
    with vfit.Recorder(ctx, folder, sensor_name="virtual") as recorder:
        for frame in ctx.open("virtual:motion=demo&frames=6"):
            recorder.write(frame)

    def indices(uri, most, **options):
        with ctx.open(uri, **options) as sensor:
            return [frame.meta("index") for frame in itertools.islice(sensor, most)]

    assert indices(f"recording:{folder}?start=4", 9) == [4, 5]
    assert indices(f"{folder}?start=4", 9, count=1) == [4]
    assert indices(f"recording:{folder}?loop=1&start=4", 5) == [4, 5, 4, 5, 4]
    for value in (-1, "abc", 6):
        with pytest.raises(vfit.Error, match=rf"option start: '{value}' is not a whole number in 0\.\.5"):
            ctx.open(f"recording:{folder}?start={value}")


def test_options_modes_and_info(ctx):
    sensor = ctx.open("virtual:", motion="scan", frames=2, noise=0, shadow=False)
    options = sensor.options()
    assert (options["motion"].value, options["frames"].value, options["shadow"].value) == ("scan", "2", "0")
    assert options["motion"].text
    assert all(mode.width > 0 and mode.rate_hz > 0 for mode in sensor.modes())
    with pytest.raises(vfit.Error, match="motion"):
        sensor.set_option("motion", "fly")
    assert sum(1 for _ in sensor) == 2
    assert sensor.acquire(timeout_s=1e300) is None and sensor.ended
    assert frame_measures(ctx)["stature_m"] > 1
    assert {p.name for p in ctx.plugins()}
    assert "virtual:" in {s.uri for s in ctx.sensors()}
    assert ctx.sensor_changes() >= len(ctx.plugins())


def frame_measures(ctx):
    return next(ctx.open("virtual:motion=scan&frames=1")).meta("measures")
