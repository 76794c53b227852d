"""Errors are exceptions that carry the code and the library's own sentence."""

import pytest

import vfit
from vfit import ResultCode


def test_every_error_is_a_vfit_error_with_its_code(ctx):
    cases = [
        (lambda: ctx.open("nothing:"), vfit.Error),
        (lambda: ctx.open("recording:/nowhere"), vfit.Error),
        (lambda: vfit.SizeChart.open(ctx, "no_such_chart"), vfit.FileError),
        (lambda: vfit.SizeChart.load(ctx, "{"), vfit.DataError),
        (lambda: vfit.Garment.load(ctx, "not json"), vfit.DataError),
        (lambda: vfit.Scan(ctx).measure(), vfit.StateError),
        (lambda: vfit.Motion(ctx).pose(), vfit.StateError),
        (lambda: vfit.Motion(ctx, filter="kalman"), vfit.ArgumentError),
        (lambda: vfit.Motion(ctx, contact_rule="guess"), vfit.ArgumentError),
        (lambda: vfit.Motion(ctx, prediction_s=1.0), vfit.ArgumentError),
        (lambda: vfit.Scan(ctx, sex="x"), vfit.ArgumentError),
        (lambda: vfit.Avatar.from_shape(ctx, {"wings": 1.0}), vfit.ArgumentError),
        (lambda: vfit.Avatar.from_shape(ctx, {"weight" * 20: 1.0}), vfit.ArgumentError),
        (lambda: vfit.Avatar.from_measures(ctx, {"chest_girth_m": 1.0}), vfit.DataError),
        (lambda: ctx.load_plugin("/nowhere.so"), vfit.Error),
        (lambda: vfit.Context(axes=9), vfit.ArgumentError),
    ]
    for call, kind in cases:
        with pytest.raises(kind) as caught:
            call()
        error = caught.value
        assert isinstance(error, vfit.Error) and isinstance(error.code, ResultCode) and error.code < 0
        assert len(str(error)) > 8 and "ERROR_" not in str(error), str(error)
    assert ctx.stats().handle_count == 0, "a failed call leaves no object"


def test_errors_are_also_the_usual_kinds(ctx):
    with pytest.raises(ValueError):
        ctx.open("")
    with pytest.raises(ValueError):
        vfit.SizeChart.load(ctx, "[]")


def test_wrong_types_are_type_errors(ctx):
    with pytest.raises(TypeError):
        vfit.Scan(None)
    with pytest.raises(TypeError):
        vfit.Scan(ctx, 30)
    with pytest.raises(TypeError):
        ctx.open(7)


def test_log_lines_are_polled(tmp_path):
    (tmp_path / "vfit_broken.so").write_bytes(b"no library")
    with vfit.Context(plugin_dir=tmp_path) as ctx:
        lines = ctx.log()
        assert [line.level for line in lines] == [vfit.LogLevel.WARNING] and "vfit_broken" in lines[0].message
        assert ctx.log() == []


def test_the_profile_counts_stages(ctx, frame, standing):
    vfit.Tracker(ctx).submit(frame, standing)
    assert ctx.profile()["track"].calls == 1
    ctx.reset_profile()
    assert ctx.profile()["track"].calls == 0
    assert ctx.time_ns > 0
