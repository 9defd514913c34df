"""Whether `gyrostat diagnose --simulated` names what a simulator lacks as well as the built-in mode does.

    check_both_modes.py PROGRAM CHECK FOLDER [SEED [EFFECT…]]

Scenarios, effects and strengths are those of CHECK, a blind check's file. Of each effect (default: every one that stands
alone there) a recording is simulated with it, at a strength that SEED draws, and three without any; the user's simulator
is the same scenario without it, two traces of other trials. Recordings are shuffled and numbered, and which is which
stays in this process until all are answered. An answer is right where its verdict is the very effect; "among" counts
effects that were found and are not the verdict.
"""
import json
import random
import subprocess
import sys
import time
from pathlib import Path

program, check, folder = sys.argv[1], json.loads(Path(sys.argv[2]).read_text()), Path(sys.argv[3])
seed = int(sys.argv[4]) if len(sys.argv) > 4 else 20261123
asked = sys.argv[5:]
NONES, TRACES = 3, 2
folder.mkdir(parents=True, exist_ok=True)
draw = random.Random(seed)

cases = []
for case in check["cases"]:
    if "and" in case or (asked and case["effect"] not in asked):
        continue
    strength = draw.choice([s for s in ("medium", "strong") if s in case])
    cases.append((case["effect"], strength, case["scenario"], [{"effect": case["effect"], **case[strength]}]))
cases += [("none", "", draw.choice(list(check["scenarios"])), []) for _ in range(NONES if not asked else 0)]
draw.shuffle(cases)


def simulate(scenario, effects, trial, name):
    study = {"title": "a case", "seed": seed, "cells": [{"name": "case", "trials": 10000, "filters": ["none"],
             "scenario": {**check["scenarios"][scenario], "effects": effects}}]}
    (folder / "case.json").write_text(json.dumps(study))
    subprocess.run([program, "simulate", "case.json", "--trial", str(trial), "--out", name], cwd=folder, check=True,
                   capture_output=True)
    (folder / "case.json").unlink()


def diagnosed(name, *more):
    begun = time.monotonic()
    ended = subprocess.run([program, "diagnose", name, "--json", "out.json", *more], cwd=folder, capture_output=True,
                           text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads((folder / "out.json").read_text()), time.monotonic() - begun


def names(answer):
    return {effect["effect"] for effect in answer["effects"]}


for number, (_, _, scenario, effects) in enumerate(cases):
    simulate(scenario, effects, number, f"rec_{number:02}.csv")
    for trace in range(TRACES):
        simulate(scenario, [], len(cases) + TRACES * number + trace, f"sim_{number:02}_{trace}.csv")

answers = []
for number in range(len(cases)):
    rec = f"rec_{number:02}.csv"
    built_in, built_in_s = diagnosed(rec)
    compared, compared_s = diagnosed(rec, "--simulated", *(f"sim_{number:02}_{t}.csv" for t in range(TRACES)))
    answers.append((built_in, compared))
    print(f"{number + 1} of {len(cases)}: {built_in_s:.0f} s and {compared_s:.0f} s", file=sys.stderr, flush=True)

# Only here the labels are looked at.
totals = {mode: {"right": 0, "among": 0, "unknown": 0, "none": 0, "another": 0} for mode in ("built-in", "simulated")}
quiet = dict.fromkeys(totals, 0)
print(f"{'effect':24}{'strength':10}{'built-in':26}{'--simulated':26}{'p':>8}{'closed':>8}{'':2}")
for (label, strength, _, _), (built_in, compared) in sorted(zip(cases, answers), key=lambda both: both[0][:2]):
    for mode, answer in (("built-in", built_in), ("simulated", compared)):
        verdict = answer["verdict"]
        if label == "none":
            quiet[mode] += verdict == "none"
        else:
            totals[mode]["right" if verdict == label else "among" if label in names(answer) else
                         verdict if verdict in ("unknown", "none") else "another"] += 1
    undecided = ", ".join(u["effect"] for u in compared["undecided"])
    print(f"{label:24}{strength:10}{built_in['verdict']:26}{compared['verdict']:26}{compared['gap']['p_before']:8.4f}"
          f"{compared['gap']['closed']:8.2f}  {'undecided: ' + undecided if undecided else ''}")
for mode, counts in totals.items():
    print(f"{mode}: " + ", ".join(f"{n} {what}" for what, n in counts.items())
          + f"; none said of {quiet[mode]} of {sum(c[0] == 'none' for c in cases)} without an effect")
