"""Folders and studies that the tests of the Python package share."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy  # noqa: F401
except ImportError:
    print("SKIPPED: needs Debian's python3-numpy")
    sys.exit(0)

PROGRAM = os.environ["GYROSTAT_PROGRAM"]

SMALL = {"title": "small", "seed": 7, "cells": [
    {"name": "still", "trials": 6, "filters": ["none", "kf", "oracle"], "scenario": {"duration_s": 10, "rate_hz": 20}}]}


def small(*filters, trials=6, **scenario):
    cell = dict(SMALL["cells"][0], trials=trials)
    if filters:
        cell["filters"] = list(filters)
    cell["scenario"] = cell["scenario"] | scenario
    return dict(SMALL, cells=[cell])


def program(*arguments, expected=0):
    """(what it printed, what it complained of)."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == expected, (done.returncode, done.stderr)
    return done.stdout, done.stderr


class InAFolder(unittest.TestCase):
    def setUp(self):
        here = tempfile.TemporaryDirectory(prefix="gyrostat_python_")
        before = os.getcwd()
        os.chdir(here.name)
        self.addCleanup(here.cleanup)
        self.addCleanup(os.chdir, before)
