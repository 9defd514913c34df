"""pip install --no-build-isolation .

Builds the package's library with CMake and what ./quickstart installs, pybind11-dev and python3-dev. In this order it
uses the build folder that the variable GYROSTAT_BUILD_DIR names, an installed gyrostat that CMake finds
(CMAKE_PREFIX_PATH), or builds all of gyrostat.
"""
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
VERSION = re.search(r"project\(gyrostat VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def configured(source, build):
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    return subprocess.run(["cmake", "-S", source, "-B", build, *generator, "-DCMAKE_BUILD_TYPE=Release",
                           f"-DPython3_EXECUTABLE={sys.executable}", "-DGYROSTAT_PYTHON=ON",
                           "-DGYROSTAT_BUILD_TESTS=OFF", "-DGYROSTAT_BUILD_BENCHMARKS=OFF"]).returncode == 0


class ByCMake(build_ext):
    def build_extension(self, extension):
        given = os.environ.get("GYROSTAT_BUILD_DIR")
        build = Path(given or Path(self.build_temp).resolve() / "alone")
        if not given and not configured(ROOT / "python", build):
            print("no installed gyrostat: building all of it", flush=True)
            build = Path(self.build_temp).resolve() / "whole"
            if not configured(ROOT, build):
                sys.exit("gyrostat cannot be built here: see what CMake says above")
        subprocess.run(["cmake", "--build", build, "--target", "gyrostat_python"], check=True)
        name = f"_library{sysconfig.get_config_var('EXT_SUFFIX')}"
        found = next(build.glob(f"**/gyrostat/{name}"), None)
        if found is None:
            sys.exit(f"{build} has no {name}: it was configured for another Python")
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(found, target)


(ROOT / "build").mkdir(exist_ok=True)
setup(version=VERSION,
      packages=["gyrostat"],
      package_dir={"gyrostat": "python/gyrostat"},
      package_data={"gyrostat": ["py.typed", "*.pyi"]},
      ext_modules=[Extension("gyrostat._library", [])],
      cmdclass={"build_ext": ByCMake},
      options={"build": {"build_base": "build/pip"}, "egg_info": {"egg_base": "build"}})
