#!/usr/bin/env python3
"""answer.py METHOD FOLDER ANSWERS: what mmd, c2st or gmwm says of each recording of an exported blind check, as
`gyrostat blind-check FOLDER --score ANSWERS --key KEY` reads it."""
import importlib
import json
import pathlib
import sys

import numpy as np

from recording import read

METHODS = ("mmd", "c2st", "gmwm")


def main(method, folder, answers):
    if method not in METHODS:
        sys.exit(f"'{method}' is no method; allowed: {', '.join(METHODS)}")
    answer = importlib.import_module(method).answer
    recordings = sorted(pathlib.Path(folder, "recordings").glob("*.csv.gz"))
    if not recordings:
        sys.exit(f"{folder}: has no recordings; allowed: a folder of gyrostat blind-check --export")
    pathlib.Path(answers).mkdir(parents=True, exist_ok=True)
    for recording in recordings:
        number = recording.name.removesuffix(".csv.gz")
        out = pathlib.Path(answers, number + ".json")
        if not out.exists():
            said = answer(read(recording), np.random.default_rng(int(number)))
            out.write_text(json.dumps(said) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
