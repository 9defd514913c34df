#!/usr/bin/env python3
"""Fills the tables of page.md from the diagnoses beside it into README.md.

    page.py [--check]                  with --check nothing is written; it fails where README.md is not what they make
    page.py --line FOUND.json FILE AXIS     what every.jsonl keeps of a diagnosis
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


def line(found, file, axis):
    """What the table of all recordings shows of a diagnosis."""
    gap, remainder = found["gap"], found.get("remainder", {})
    return {"file": file, "axis": axis, "duration_s": found["recording"]["duration_s"], "rate_hz": found["recording"]["rate_hz"],
            "verdict": found["verdict"], "effects": {e["effect"]: round(e["inclusion"], 3) for e in found["effects"]},
            "before": round(gap["before"], 3), "after": round(gap["after"], 3), "closed": round(gap["closed"], 3),
            "closed_with": round(max(gap["closed"], remainder.get("closed_with", 0.0)), 3),
            "p_before": float(f"{gap['p_before']:.2g}"), "p_after": float(f"{gap['p_after']:.2g}")}


def every():
    return [json.loads(text) for text in (here / "every.jsonl").read_text().splitlines()]


def leaves(r):
    return r["p_before"] < 0.05


def has_a_gap(r):
    """Something to close, on the part that was held back."""
    return leaves(r) and r["before"] > 0


def table_of_all():
    lines = ["| recording and axis | verdict | effects (probability) | gap | closed | with what has no name | p after |",
             "| --- | --- | --- | --- | ---: | ---: | ---: |"]
    for r in every():
        effects = ", ".join(f"{name} ({probability:.2g})" for name, probability in r["effects"].items()) or "–"
        opened = has_a_gap(r)
        lines.append(f"| {r['file']} {r['axis']} | {r['verdict']} | {effects} | {r['before']:.2f} → {r['after']:.2f} | "
                     + (f"{100 * r['closed']:.0f} % | {100 * r['closed_with']:.0f} %" if opened else "– | –")
                     + f" | {r['p_after']:.2g} |")
    return "\n".join(lines)


def median(values):
    ordered = sorted(values)
    return (ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def in_short():
    """The sentence of numbers over all recordings whose gap is seen."""
    opened = [r for r in every() if has_a_gap(r)]
    closed = [r["closed"] for r in opened]
    nameless = [r["closed_with"] for r in opened]
    wide = [r for r in opened if r["before"] > 1]
    return (f"Of {len(every())} axes {sum(map(leaves, every()))} leave the simulator as it stands (p < .05), {len(opened)} of "
            f"them where they were held back, too. Named effects close a median of "
            f"{100 * median(closed):.0f} % of the gap of these (least {100 * min(closed):.0f} %), with what has no name "
            f"{100 * median(nameless):.0f} % (least {100 * min(nameless):.0f} %); in "
            f"{sum(r['p_after'] >= 0.05 for r in opened)} nothing more is seen to be left. Of the "
            f"{len(wide)} whose gap is above one spread the medians are {100 * median([r['closed'] for r in wide]):.0f} % and "
            f"{100 * median([r['closed_with'] for r in wide]):.0f} %.")


def main():
    if sys.argv[1:2] == ["--line"]:
        print(json.dumps(line(json.loads(Path(sys.argv[2]).read_text()), *sys.argv[3:5])))
        return
    text = (here / "page.md").read_text().replace("{{gaps}}", table())
    text = text.replace("{{all}}", table_of_all()).replace("{{in short}}", in_short())
    text = text.replace("{{promises adis_1_x}}", promises("adis_1_x")).replace("{{promises mtig_first}}", promises("mtig_first"))
    target = here / "README.md"
    if "--check" in sys.argv[1:]:
        if target.read_text() != text:
            sys.exit(f"{target} is not what page.md and the diagnoses make: run page.py")
        return
    target.write_text(text)


main()
