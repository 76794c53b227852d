"""The package itself: version, names, self-containment, types."""

import ast
import enum
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import vfit
from conftest import ROOT

PACKAGE = Path(vfit.__file__).parent


def test_version_is_that_of_the_library_and_of_the_metadata():
    from importlib.metadata import version

    assert vfit.__version__ == version("vfit")
    info = vfit.info()
    assert info.version == vfit.__version__
    assert info.simd and info.build


def test_names_come_from_the_library():
    assert vfit.Joint.HEAD == 0 and vfit.Joint["RIGHT_TOES"] == 22 and len(vfit.Joint) == 23
    assert vfit.Bone.LEFT_UPPER_ARM == vfit.BONE_NAMES.index("leftUpperArm")
    assert vfit.BONE_PARENTS[vfit.Bone.HIPS] == -1
    assert all(parent < bone for bone, parent in enumerate(vfit.BONE_PARENTS))
    assert "stature_m" in vfit.MEASURES and all(vfit.MEASURES.values())
    assert vfit.ResultCode.ERROR_DATA == -11 and vfit.ResultCode.END_OF_STREAM == 4


def test_library_plugins_and_data_lie_in_the_package():
    assert list(PACKAGE.glob("*vfit*.so*")) or sys.platform != "linux"
    assert list((PACKAGE / "vfit_plugins").iterdir())
    assert (PACKAGE / "vfit_data" / "body.bin").is_file()
    assert (PACKAGE / "py.typed").is_file()
    assert all(os.access(reader, os.X_OK) for reader in (PACKAGE / "vfit_plugins").glob("*_reader"))
    with vfit.Context() as ctx:
        loaded = {plugin.name: Path(plugin.path) for plugin in ctx.plugins()}
    assert loaded and all(path.parent == PACKAGE / "vfit_plugins" for path in loaded.values())


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_only_the_library_in_the_package_is_loaded():
    script = "import vfit; vfit.Context(); print(open('/proc/self/maps').read())"
    maps = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    files = {line.split()[-1] for line in maps.split("\n") if "vfit" in line.rpartition("/")[2]}
    assert any("libvfit" in file for file in files)
    assert all(Path(file).is_relative_to(PACKAGE) for file in files), files


def stub_classes():
    tree = ast.parse((PACKAGE / "_vfit.pyi").read_text())
    return {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}


def test_the_stub_names_what_the_module_has():
    from vfit import _vfit

    stub = stub_classes()
    public = {name for name in dir(_vfit) if isinstance(getattr(_vfit, name), type)}
    assert {name for name in stub if not name.startswith("_")} == public
    shared = {node.name for node in stub["_Closable"].body if isinstance(node, ast.FunctionDef)}
    for name in public:
        actual = getattr(_vfit, name)
        if issubclass(actual, enum.Enum):
            members = {
                n.targets[0].id: ast.literal_eval(n.value)
                for n in stub[name].body
                if isinstance(n, ast.Assign)
            }
            assert members == {m.name: m.value for m in actual}, name
            continue
        named = {node.name for node in stub[name].body if isinstance(node, ast.FunctionDef)} | shared
        has = {
            n
            for n in vars(actual)
            if not n.startswith("_") or n in ("__enter__", "__exit__", "__iter__", "__next__", "__contains__")
        }
        assert named - {"__init__"} == has, name


def test_every_function_of_the_library_is_bound():
    header = (ROOT / "include" / "vfit.h").read_text()
    native = "".join(file.read_text() for file in (ROOT / "bindings" / "python" / "native").iterdir())
    functions = set(re.findall(r"^VFIT_API [^;]*?\b(vfit_\w+)\(", header, re.MULTILINE))
    assert len(functions) > 100
    assert {name for name in functions if not re.search(rf"\b{name}\b", native)} == {
        "vfit_shutdown"
    }  # arrays may be alive


def test_every_class_of_the_module_is_exported():
    from vfit import _vfit

    for name in dir(_vfit):
        if not name.startswith("_"):
            assert getattr(vfit, name) is getattr(_vfit, name)


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_mypy_sees_the_types(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import vfit\n"
        "with vfit.Context() as ctx:\n"
        "    for frame in ctx.open('virtual:'):\n"
        "        reveal_type(frame.depth)\n"
        "        reveal_type(frame.joints()['HEAD'].x)\n"
        "    reveal_type(vfit.Scan(ctx, sex='f').measure()['stature_m'].value)\n"
        "    vfit.Scan(ctx, frames='many')\n"
    )
    sample = ROOT / "samples" / "01_fit_a_recording" / "fit.py"
    run = subprocess.run(
        [
            sys.executable,
            "-m",
            "mypy",
            "--strict",
            "--cache-dir",
            str(tmp_path / "cache"),
            str(program),
            str(sample),
        ],
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert "unsignedinteger" in run.stdout and run.stdout.count('"float"') == 2, run.stdout + run.stderr
    errors = [line for line in run.stdout.splitlines() if ": error:" in line]
    assert len(errors) == 1 and 'has incompatible type "str"; expected "int"' in errors[0], run.stdout
