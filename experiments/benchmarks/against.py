#!/usr/bin/env python3
"""How long this tree takes against an earlier commit: the same studies by both, one after the other in turns.

    experiments/benchmarks/against.py COMMIT [--rounds 9] [--folder build/against] [--new build/release/gyrostat]

Builds COMMIT in a worktree of its own (kept in the folder, so that it is built once) and runs each study with few and with
more trials by the earlier program and by the new one, in turns. What is printed is processor time, the least of the rounds,
since other work on the machine only adds: of a trial (the difference over the trials between, so that neither start nor
calibration counts) and of `gyrostat --help`.
"""
import argparse
import json
import os
import resource
import shutil
import subprocess
from pathlib import Path

SIX = ["none", "kf", "stf", "sr_ukf", "sr_rsukf", "oracle"]
THERMAL = ["none", "thermal_mlr", "thermal_kf", "thermal_lsm", "thermal_stf", "oracle"]
STUDIES = {
    "a minute at 100 Hz, six methods": (64, 1024, SIX, {"duration_s": 60, "rate_hz": 100}),
    "the same, SR-UKF alone": (64, 1024, ["sr_ukf"], {"duration_s": 60, "rate_hz": 100}),
    "an hour at 20 Hz, thermal methods": (8, 72, THERMAL, {
        "duration_s": 3600, "rate_hz": 20,
        "random_error": {"phi": 0.5, "delta1_dps": 2e-5, "delta2_dps": 1e-5, "measurement_noise_std_dps": 0.02},
        "thermal_drift": {"a_dps_per_C": 0.002, "b_dps_s_per_C": 0.1, "c_dps": -0.05},
        "temperature": {"profile": "ramp_and_cooling", "start_C": 23, "peak_C": 57, "room_C": 23, "ramp_s": 1200,
                        "cooling_time_constant_s": 800},
        "effects": [{"effect": "thermal_curvature", "curvature_dps_per_C2": 5e-5, "reference_C": 40},
                    {"effect": "thermal_hysteresis", "amplitude_dps": 0.01, "width_C": 4}],
        "compass": {"noise_std_deg": 0.05, "disturbances": [
            {"start_s": 600, "duration_s": 300, "offset_deg": 10, "noise_std_deg": 1},
            {"start_s": 1500, "duration_s": 300, "offset_deg": -8, "noise_std_deg": 1}]}}),
}


def built(commit, folder, tree):
    worktree = folder / "tree"
    if not worktree.exists():
        subprocess.run(["git", "worktree", "add", "--detach", worktree, commit], cwd=tree, check=True)
        if (tree / "node_modules").exists():
            (worktree / "node_modules").symlink_to((tree / "node_modules").resolve())
    subprocess.run(["git", "checkout", "--detach", commit], cwd=worktree, check=True)
    subprocess.run(["cmake", "--preset", "release"], cwd=worktree, check=True)
    subprocess.run(["cmake", "--build", "--preset", "release", "--target", "gyrostat"], cwd=worktree, check=True)
    return worktree / "build/release/gyrostat"


def processor_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def least(programs, arguments, rounds, folder):
    """Of each program, over all rounds."""
    best = [float("inf")] * len(programs)
    for _ in range(rounds):
        for i, program in enumerate(programs):
            shutil.rmtree(folder / "run", ignore_errors=True)
            best[i] = min(best[i], processor_seconds([program, *arguments]))
    return best


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("commit", help="the earlier one, or the path of a program built from it")
    options.add_argument("--rounds", type=int, default=9)
    options.add_argument("--folder", type=Path, default=Path("build/against"))
    options.add_argument("--new", type=Path, default=Path("build/release/gyrostat"))
    options.add_argument("--lanes", help="trials side by side in both: 2 is SSE2, 4 AVX2, 8 what is widest here")
    told = options.parse_args()
    tree = Path(__file__).resolve().parents[2]
    folder = told.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    given = Path(told.commit)
    old = given.resolve() if given.is_file() and os.access(given, os.X_OK) else built(told.commit, folder, tree)
    programs = [str(old), str(told.new.resolve())]
    print(f"{'':36} {'earlier':>12} {'new':>12} {'ratio':>6}")
    for name, (few, many, methods, scenario) in STUDIES.items():
        study = folder / "study.json"
        study.write_text(json.dumps({"title": name, "seed": 1, "cells": [{
            "name": "against", "trials": many, "parameters_from": "truth", "scenario": scenario, "filters": methods}]}))
        lanes = ["--lanes", told.lanes] if told.lanes else []
        seconds = [least(programs, ["run", str(study), "--trials", str(trials), "--threads", "1",
                                    "--out", str(folder / "run"), *lanes], told.rounds, folder) for trials in (few, many)]
        was, now = ((after - before) / (many - few) for before, after in zip(*seconds))
        print(f"{name:36} {1e6 * was:9.0f} µs {1e6 * now:9.0f} µs {now / was:6.3f}", flush=True)
    was, now = least(programs, ["--help"], told.rounds, folder)
    print(f"{'gyrostat --help':36} {1e3 * was:9.1f} ms {1e3 * now:9.1f} ms {now / was:6.3f}")


if __name__ == "__main__":
    main()
