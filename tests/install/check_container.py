"""The Containerfile builds an image whose gyrostat works on files of the folder it is called in.

    check_container.py ROOT

Needs podman or docker, and a daemon that answers where it is docker's; else says why it is skipped. Where nothing can be
built, what the recipe takes from quickstart and from CMake is still looked up.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(sys.argv[1])


def require_recipe_is_current():
    """What it names is there: the list of packages as the recipe reads it, the options, the preset."""
    recipe = (root / "Containerfile").read_text()
    command = re.search(r"sed -n (.*?) quickstart > /packages", recipe).group(0).replace("/packages", "/dev/stdout")
    packages = subprocess.run(["sh", "-c", f'eval "$({command})"; echo $packages'], cwd=root, capture_output=True,
                              text=True, check=True).stdout.split()
    assert {"g++", "cmake", "libceres-dev", "libsodium-dev"} <= set(packages), packages
    assert "python3-numpy" not in packages, "what only tests need is not to be installed"
    options = (root / "CMakeLists.txt").read_text() + "".join(p.read_text() for p in (root / "cmake").glob("*.cmake"))
    for option in re.findall(r"-D(GYROSTAT_\w+)", recipe):
        assert option in options, option


def engine():
    for name in ("podman", "docker"):
        if shutil.which(name) and subprocess.run([name, "info"], capture_output=True, timeout=60).returncode == 0:
            return name
    return None


require_recipe_is_current()
name = engine()
if name is None:
    print("SKIPPED: needs podman, or docker with its daemon running; the recipe names what there is")
    sys.exit(0)

image = "gyrostat-of-a-test"
subprocess.run([name, "build", "-q", "-t", image, "-f", "Containerfile", "."], cwd=root, check=True)
try:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "study.json").write_text(
            '{"title": "in a container", "seed": 1, "cells": [{"name": "a", "trials": 20, "filters": ["none", "kf"],'
            ' "scenario": {"duration_s": 10, "rate_hz": 50}}]}')

        def gyrostat(*arguments):
            return subprocess.run([name, "run", "--rm", "-v", f"{folder}:/data", image, *arguments], capture_output=True,
                                  text=True, check=True).stdout

        assert "kf has the smallest" in gyrostat("run", "study.json", "--out", "out")
        assert (Path(folder) / "out" / "tables.json").exists()
        assert "ranking by bias_rmse" in gyrostat("rank", "out")
        assert gyrostat("--version").strip()
finally:
    subprocess.run([name, "rmi", "-f", image], capture_output=True)
print(f"built and used with {name}")
