#!/usr/bin/env python3
"""Compares `gyrostat apply` with the covariance-form reference.

Usage: check_apply.py GYROSTAT_BINARY WORKDIR

Numbers must agree to 1e-9 relative to max(|reference|, RMS of the reference's
column), blanks must coincide and statuses must be equal. Exits 1 on any failure
and when nothing was compared.
"""
import csv
import glob
import json
import os
import subprocess
import sys

import numpy as np

import apply_reference
import make_inputs

TOLERANCE = 1e-9
NUMERIC_COLUMNS = ("estimate_dps", "innovation_dps", "innovation_variance")


def read_columns(path):
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, zip(*rows)))


def worst_difference(actual, expected):
    """Worst relative difference of two text columns; infinite where they cannot be compared."""
    if len(actual) != len(expected) or any((a == "") != (e == "")
                                           for a, e in zip(actual, expected)):
        return np.inf
    try:
        actual = np.array([float(cell) for cell in actual if cell != ""])
    except ValueError:
        return np.inf
    expected = np.array([float(cell) for cell in expected if cell != ""])
    difference = np.abs(actual - expected)
    if not np.all(np.isfinite(difference)):
        return np.inf
    if not np.any(difference):
        return 0.0
    scale = np.maximum(np.abs(expected), np.sqrt(np.mean(expected ** 2)))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.max(np.where(difference == 0.0, 0.0, difference / scale))


def compare_filter(name, actual, expected):
    """Prints the differences of one filter; returns whether they are within tolerance."""
    good, parts = True, []
    for column in NUMERIC_COLUMNS:
        key = f"{name}_{column}"
        worst = worst_difference(actual.get(key, ()), expected[key])
        good = good and worst <= TOLERANCE
        count = sum(cell != "" for cell in expected[key])
        parts.append(f"{column} {worst:.1e} ({count})")
    key = f"{name}_status"
    same_status = actual.get(key) == expected[key]
    parts.append("status " + ("equal" if same_status else "DIFFERS"))
    return good and same_status, ", ".join(parts)


def check_config(binary, directory, input_path, config_path):
    """Returns the verdicts of one configuration, one for each line printed."""
    name = os.path.basename(config_path)[len("config_"):-len(".json")]
    expected_path = os.path.join(directory, f"reference_{name}.csv")
    actual_path = os.path.join(directory, f"program_{name}.csv")
    apply_reference.main(input_path, config_path, expected_path)
    if os.path.exists(actual_path):
        os.remove(actual_path)
    run = subprocess.run([binary, "apply", input_path, "--config", config_path,
                          "--out", actual_path], capture_output=True, text=True)
    if run.returncode != 0 or not os.path.exists(actual_path):
        print(f"FAIL {name}: exit status {run.returncode}: {run.stderr.strip()}")
        return [False]
    expected, actual = read_columns(expected_path), read_columns(actual_path)
    verdicts = []
    for column in ("t_s", "raw_dps"):
        if worst_difference(actual.get(column, ()), expected[column]) != 0.0:
            print(f"FAIL {name}: column {column} differs")
            verdicts.append(False)
    with open(config_path) as file:
        filters = json.load(file)["filters"]
    for entry in filters:
        filter_id = entry.get("id", entry["filter"])
        good, text = compare_filter(filter_id, actual, expected)
        print(f"{'ok  ' if good else 'FAIL'} {name} {filter_id}: {text}")
        verdicts.append(good)
    return verdicts


def main(binary, directory):
    for stale in glob.glob(os.path.join(directory, "config_*.json")):
        os.remove(stale)
    make_inputs.main(directory)
    input_path = os.path.join(directory, "input.csv")
    config_paths = sorted(glob.glob(os.path.join(directory, "config_*.json")))
    verdicts = [verdict for config_path in config_paths
                for verdict in check_config(binary, directory, input_path, config_path)]
    print(f"{sum(verdicts)} of {len(verdicts)} comparisons within {TOLERANCE:g}")
    return 0 if verdicts and all(verdicts) else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
