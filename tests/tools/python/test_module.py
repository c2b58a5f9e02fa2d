"""The module as it is told: stubs, docstrings, documents, the example, and pip."""
import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

import quorum

PACKAGE = Path(quorum.__file__).parent


def stub():
    """Names of the stub: of the module, and by class."""
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    names, members = set(), {}
    for node in tree.body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            names.add(node.name)
        if isinstance(node, ast.ClassDef):
            members[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
    return names, members


def test_the_stub_tells_all_of_the_module():
    names, members = stub()
    assert names | {"Error", "ErrorKind"} == set(quorum.__all__)
    assert (PACKAGE / "py.typed").exists()
    for name, told in members.items():
        there = {member for member in vars(getattr(quorum, name)) if not member.startswith("_")}
        assert told - {"__len__"} == there, name


def test_arguments_are_those_of_the_stub():
    tree = ast.parse((PACKAGE / "__init__.pyi").read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef) and node.name in ("reconstruct", "from_arrays", "choose_device"):
            told = [argument.arg for argument in node.args.args + node.args.kwonlyargs]
            owner = quorum.Scene if node.name == "from_arrays" else quorum
            signature = getattr(owner, node.name).__doc__.split("\n", 1)[0]
            assert re.findall(r"(\w+): ", signature.split("**")[0]) == told


def test_everything_has_a_docstring():
    for name in quorum.__all__:
        thing = getattr(quorum, name)
        assert thing.__doc__, name
        if isinstance(thing, type) and not issubclass(thing, Exception):
            for member, value in vars(thing).items():
                assert member.startswith("_") or value.__doc__, (name, member)


def test_errors_are_exit_codes():
    error = quorum.Error(4, "no such device")
    assert error.kind is quorum.ErrorKind.NO_DEVICE and int(error.kind) == 4
    assert str(error) == error.message == "no such device"


def test_the_document_shows_the_example_as_it_is():
    code = (ROOT / "docs" / "examples" / "turntable.py").read_text()
    assert f"```python\n{code}```\n" in (ROOT / "docs" / "python.md").read_text()


def test_the_example_runs(tmp_path):
    example = ROOT / "docs" / "examples" / "turntable.py"
    said = subprocess.run([sys.executable, example, tmp_path], capture_output=True, text=True, check=True).stdout
    assert abs(float(re.search(r"middle ([\d.]+);", said)[1]) - 3) < 0.02
    assert float(re.search(r"are ([\d.]+) off", said)[1]) < 0.01
    assert {path.name for path in tmp_path.iterdir()} == {"mesh.npz", "depth.npz"}


def test_pip_installs_it(tmp_path):
    """From the build that is there, so that nothing is compiled again; the module finds the library beside it."""
    pip = [sys.executable, "-m", "pip"]
    if subprocess.run([*pip, "--version"], capture_output=True).returncode != 0:
        pytest.skip("pip is not there: python3-pip")
    environment = {**os.environ, "QUORUM_BUILD": os.environ["QUORUM_BUILD_FOLDER"]}
    flags = ["--no-build-isolation", "--no-index", "--no-deps", "--disable-pip-version-check"]
    flags += ["--target", tmp_path / "there"]
    install = [*pip, "install", *flags, ROOT / "tools" / "python"]
    done = subprocess.run(install, capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
    environment["PYTHONPATH"] = str(tmp_path / "there")
    code = "import quorum; print(quorum.__file__, quorum.__version__, open('/proc/self/maps').read())"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment)
    said = loaded.stdout
    assert said.startswith(str(tmp_path)) and quorum.__version__ in said
    libraries = set(re.findall(r"\S+/libquorum\S+", said))
    assert {Path(library).parent for library in libraries} == {tmp_path / "there" / "quorum"}
