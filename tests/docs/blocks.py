"""The code blocks of a page, in order, and runs of the program in a folder of their own."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def blocks_of(page, *languages):
    """(language, text) of every block of the page in one of the languages."""
    found = re.findall(r"^```(\w+)\n(.*?)^```$", Path(page).read_text(), re.M | re.S)
    return [(language, text) for language, text in found if language in languages]


def skip_without(*modules):
    for module in modules:
        try:
            __import__(module)
        except ImportError:
            print(f"SKIPPED: needs Debian's python3-{module}")
            sys.exit(0)


class Folder:
    """A clean folder in which `gyrostat` is the program under test."""

    def __init__(self, program):
        self.path = Path(tempfile.mkdtemp(prefix="gyrostat_docs_"))
        self.environment = dict(os.environ, PATH=f"{Path(program).resolve().parent}:{os.environ['PATH']}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)

    def shell(self, script, expected=0):
        """Its output; stops the test where the exit code is another. -e: every command must succeed."""
        done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", script], cwd=self.path, env=self.environment,
                              capture_output=True, text=True)
        if done.returncode != expected:
            sys.exit(f"exit code {done.returncode}, not {expected}:\n{script}\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
        return done.stdout


SMALL_STUDY = """{"title": "small", "seed": 7, "cells": [
  {"name": "still", "trials": 12, "filters": ["none", "kf", "kf_ma", "oracle"],
   "scenario": {"duration_s": 10, "rate_hz": 50}},
  {"name": "warm, \\u00b10 \\u00b0C", "trials": 5, "filters": ["none", {"id": "stf_1.05", "filter": "stf"}],
   "scenario": {"duration_s": 12, "rate_hz": 50, "temperature": {"profile": "cycle"}}}]}
"""
