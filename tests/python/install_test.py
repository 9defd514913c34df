"""pip install --no-build-isolation . in a fresh virtual environment, with the libraries of the build."""
import importlib.util
import os
import subprocess
import sys
import tempfile
from pathlib import Path

for module in ("pip", "setuptools", "wheel", "venv", "numpy"):
    if importlib.util.find_spec(module) is None:
        print(f"SKIPPED: needs Debian's python3-{module}")
        sys.exit(0)

source = os.environ["GYROSTAT_SOURCE_DIR"]
environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONDONTWRITEBYTECODE")}


def done(*command, **how):
    """What it printed; ends the test where it fails."""
    result = subprocess.run(command, capture_output=True, text=True, env=environment, **how)
    if result.returncode:
        sys.exit(f"{' '.join(map(str, command))}: {result.returncode}\n{result.stdout[-3000:]}\n{result.stderr[-3000:]}")
    return result.stdout


with tempfile.TemporaryDirectory(prefix="gyrostat_pip_") as folder:
    # pip is that of the system, which it shows like all else of Debian's: nothing is downloaded.
    done(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", f"{folder}/fresh")
    python = f"{folder}/fresh/bin/python"
    done(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--disable-pip-version-check", source,
         cwd=folder)
    program = """
import gyrostat, importlib.metadata, os
run = gyrostat.run({"cells": [{"name": "a", "trials": 2, "filters": ["none", "kf"], "scenario": {"duration_s": 5}}]})
print(gyrostat.__file__)
print(importlib.metadata.version("gyrostat"), gyrostat.__version__, len(run.outcomes()["trial"]))
print(os.path.exists(os.path.join(os.path.dirname(gyrostat.__file__), "py.typed")))
"""
    where, versions, typed = done(python, "-c", program, cwd=folder).splitlines()
    assert Path(where).is_relative_to(f"{folder}/fresh"), where
    assert versions.split()[0] == versions.split()[1] and versions.split()[2] == "4", versions
    assert typed == "True"
print("installed by pip, imported and run:", versions)
