"""Whether `gyrostat diagnose --simulated` finds nothing between two halves of one recording.

    check_halves.py PROGRAM FOLDER [PAIRS [SEED [RECORDING.csv.gz…]]]

PAIRS halves of sensors of white noise, a walk and a Gauss-Markov error, whose strength and memory SEED draws, by
`gyrostat simulate`; then halves of the recordings named, every axis, in stretches of at most 40,000 samples and of those
at most two an axis. One half is the recording, the other the simulator. Where nothing differs, p is uniform and a verdict
other than `none` comes with a probability of at most 0.02. A real sensor is not bound to be the same in both halves.
"""
import csv
import gzip
import json
import math
import random
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
pairs = int(sys.argv[3]) if len(sys.argv) > 3 else 30
seed = int(sys.argv[4]) if len(sys.argv) > 4 else 20261123
recordings = [Path(name).absolute() for name in sys.argv[5:]]
STRETCH, STRETCHES, FEWEST = 40000, 2, 8192
folder.mkdir(parents=True, exist_ok=True)
draw = random.Random(seed)


def write(name, times, rates):
    lines = [f"{t - times[0]:.9g},{rate}" for t, rate in zip(times, rates)]
    (folder / name).write_text("t_s,gyro_dps\n" + "\n".join(lines) + "\n")


def compared(times, rates):
    middle = len(times) // 2
    write("first.csv", times[:middle], rates[:middle])
    write("second.csv", times[middle:], rates[middle:])
    ended = subprocess.run([program, "diagnose", "first.csv", "--simulated", "second.csv", "--json", "out.json"],
                           cwd=folder, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    answer = json.loads((folder / "out.json").read_text())
    return answer["gap"]["p_before"], answer["verdict"], [e["effect"] + " " + e["simulator"] for e in answer["effects"]]


def kolmogorov(values):
    """The distance from the uniform distribution, and Kolmogorov's probability of so large a one (Stephens 1970)."""
    n, ordered = len(values), sorted(values)
    distance = max(max((k + 1) / n - p, p - k / n) for k, p in enumerate(ordered))
    x = distance * (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))
    return distance, min(1.0, max(0.0, 2 * sum((-1) ** (k - 1) * math.exp(-2 * k * k * x * x) for k in range(1, 101))))


def told(what, results):
    accused = [(name, f"p = {p:.4f}", verdict, *effects) for name, (p, verdict, effects) in results if verdict != "none"]
    distance, chance = kolmogorov([p for _, (p, _, _) in results])
    print(f"{what}: {len(results)} pairs, {len(accused)} not told `none`; p uniform? distance {distance:.3f}, "
          f"which chance exceeds with {chance:.2f}")
    print("  p sorted: " + " ".join(f"{p:.3f}" for p in sorted(p for _, (p, _, _) in results)))
    for one in accused:
        print("  " + ", ".join(one))
    sys.stdout.flush()


results = []
for pair in range(pairs):
    strength, memory = draw.uniform(0.005, 0.05), math.exp(draw.uniform(math.log(2), math.log(60)))
    study = {"title": "halves", "seed": seed, "cells": [{"name": "halves", "trials": 10000, "filters": ["none"], "scenario": {
        "duration_s": 1200, "rate_hz": 20,
        "random_error": {"phi": 0, "delta1_dps": 3e-5, "delta2_dps": 0, "measurement_noise_std_dps": 0.05},
        "effects": [{"effect": "gauss_markov", "std_dps": strength, "correlation_time_s": memory}]}}]}
    (folder / "halves.json").write_text(json.dumps(study))
    subprocess.run([program, "simulate", "halves.json", "--trial", str(pair), "--out", "whole.csv"], cwd=folder, check=True,
                   capture_output=True)
    with open(folder / "whole.csv") as file:
        rows = [(float(row["t_s"]), row["gyro_dps"]) for row in csv.DictReader(file)]
    results.append((f"std {strength:.3f} dps, memory {memory:.0f} s", compared(*zip(*rows))))
    print(results[-1], file=sys.stderr, flush=True)
if results:
    told("Gauss-Markov sensors", results)

results = []
for recording in recordings:
    with gzip.open(recording, "rt") as file:
        rows = list(csv.DictReader(file))
    for axis in "xyz":
        channel = f"gyro_{axis}_dps"
        if not rows or channel not in rows[0]:
            continue
        for stretch in range(STRETCHES):
            part = rows[stretch * STRETCH:(stretch + 1) * STRETCH]
            if len(part) < FEWEST:
                break
            name = f"{recording.name.split('.')[0]}, {axis}, from {part[0]['t_s']} s"
            results.append((name, compared([float(r["t_s"]) for r in part], [r[channel] for r in part])))
            print(results[-1], file=sys.stderr, flush=True)
if results:
    told("recordings", results)
