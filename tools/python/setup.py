"""Builds the module with CMake: pip install --no-build-isolation tools/python (docs/python.md).

QUORUM_BUILD names the folder of a build that is configured already (build/release); else there is one in build/pip.
"""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("QUORUM_BUILD", ROOT / "build" / "pip"))


class BuildByCMake(build_ext):
    """The module, its files, and libquorum beside it, as the install component python-wheel has them."""

    def build_extension(self, ext):
        if "QUORUM_BUILD" not in os.environ:
            flags = ["-DCMAKE_BUILD_TYPE=Release", "-DQUORUM_TESTS=OFF", "-DQUORUM_PYTHON=ON"]
            flags.append(f"-DPython3_EXECUTABLE={sys.executable}")
            subprocess.run(["cmake", "-S", ROOT, "-B", BUILD, *flags], check=True)
        jobs = str(len(os.sched_getaffinity(0)))
        subprocess.run(["cmake", "--build", BUILD, "--target", "quorum_python", "--parallel", jobs], check=True)
        folder = Path(self.get_ext_fullpath(ext.name)).resolve().parents[1]
        install = ["cmake", "--install", BUILD, "--component", "python-wheel", "--prefix", folder]
        subprocess.run(install, check=True, stdout=subprocess.DEVNULL)


version = re.search(r"^project\(.* VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]
work = ROOT / "build" / "setuptools"  # beside the sources nothing is made
work.mkdir(parents=True, exist_ok=True)
setup(
    name="quorum",
    version=version,
    description="Multi-view stereo with one result on every device",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=[],
    ext_modules=[Extension("quorum._quorum", [])],
    cmdclass={"build_ext": BuildByCMake},
    options={"build": {"build_base": str(work)}, "egg_info": {"egg_base": str(work)}},
)
