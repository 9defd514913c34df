#!/usr/bin/env python3
"""Fills the tables of page.md from the diagnoses beside it into README.md.

    page.py [--check]

With --check nothing is written; it fails where README.md is not what the sources make.
"""
import json
import sys
from pathlib import Path

here = Path(__file__).parent


def diagnosis(name):
    path = here / f"{name}.json"
    return json.loads(path.read_text()) if path.exists() else None


def gap(found):
    if found is None:
        return "–"
    g = found["gap"]
    low, high = g["closed_interval"]
    return (f"{g['before']:.2f} → {g['after']:.2f}, {100 * g['closed']:.0f} % "
            f"({100 * low:.0f} to {100 * high:.0f})")


def effects(found):
    study = []
    for step in found["steps"][1:]:
        cause = [c for c in found["causes"] if c["effect"] == step["added"]][-1]
        numbers = ", ".join(f"{key} {value:.3g}" for key, value in cause["parameters"].items())
        study.append(f"{step['added']} ({numbers})")
    return "; then ".join(study) or "–"


def row(label, name, later, other):
    found = diagnosis(name)
    return (f"| {label} | {found['verdict']} | {effects(found)} | {gap(found)} | {gap(diagnosis(later))} | "
            f"{gap(diagnosis(other)) if other else '–'} |")


def table():
    lines = ["| sensor and axis | verdict | effects added, found on the first span | held-out part of that span | the other span | the other recording |",
             "| --- | --- | --- | --- | --- | --- |",
             row("MTi-G x", "mtig_first", "mtig_second", "")]
    for axis in "xyz":
        lines.append(row(f"ADIS16405 {axis}", f"adis_1_{axis}", f"adis_1_{axis}_later", f"adis_2_{axis}"))
    for axis in "xyz":
        lines.append(row(f"MPU6050 {axis}", f"mpu6050_{axis}", f"mpu6050_{axis}_later", ""))
    return "\n".join(lines)


def promises(name):
    lines = ["| filter | metric | unit | recording | simulated before | simulated after |", "| --- | --- | --- | --- | --- | --- |"]
    for t in diagnosis(name)["transfer"]:
        lines.append(f"| {t['filter']} | {t['metric']} | {t['unit']} | {t['real']:.4g} | {t['sim_before']:.4g} | {t['sim_after']:.4g} |")
    return "\n".join(lines)


def main():
    text = (here / "page.md").read_text().replace("{{gaps}}", table())
    text = text.replace("{{promises adis_1_x}}", promises("adis_1_x")).replace("{{promises mtig_first}}", promises("mtig_first"))
    target = here / "README.md"
    if "--check" in sys.argv[1:]:
        if target.read_text() != text:
            sys.exit(f"{target} is not what page.md and the diagnoses make: run page.py")
        return
    target.write_text(text)


main()
