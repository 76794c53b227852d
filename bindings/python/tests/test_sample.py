"""samples/01_fit_a_recording runs, prints measures and size, and writes nothing."""

import re
import subprocess
import sys

from conftest import ROOT

SAMPLE = ROOT / "samples" / "01_fit_a_recording" / "fit.py"


def fit(folder, *arguments):
    run = subprocess.run(
        [sys.executable, str(SAMPLE), *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=folder,
        timeout=120,
    )
    assert list(folder.iterdir()) == []
    return run


def check_output(run):
    assert run.returncode == 0 and run.stderr == "", run.stderr
    assert "stature_m" in run.stdout and "size " in run.stdout and "dressed: " in run.stdout


def test_the_virtual_person_is_fitted(tmp_path):
    check_output(fit(tmp_path))


def test_a_real_recording_is_fitted(tmp_path, recordings):
    check_output(fit(tmp_path, recordings[0]))


def test_a_missing_recording_is_named(tmp_path):
    run = fit(tmp_path, "recording:/no/such/folder")
    assert run.returncode == 1 and "/no/such/folder" in run.stderr.splitlines()[-1]


def test_the_example_of_the_readme_runs(tmp_path):
    example = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL).group(1)
    run = subprocess.run(
        [sys.executable, "-c", example], capture_output=True, text=True, cwd=tmp_path, timeout=120
    )
    assert run.returncode == 0 and run.stderr == "", run.stderr
    size, shape = run.stdout.splitlines()
    assert re.fullmatch(r"Size\(label='\w+', probability=[\d.]+\)", size), size
    assert re.fullmatch(r"\(\d{4}, 3\)", shape), shape
