#!/usr/bin/env python3
"""Fills the tables of page.md from fleet.json into README.md.

    page.py [--check]
    page.py --collect FOLDER    makes fleet.json of FOLDER/FLEET_AXIS.json, as diagnose --json writes them

With --check nothing is written; it fails where README.md is not what the sources make.
"""
import json
import statistics
import sys
from pathlib import Path

here = Path(__file__).parent
fleets = {"dot": "Xsens DOT", "adis": "ADIS16405"}


def unit_name(sensor):
    """xsens_dot_03_static.csv.gz: 03; adis16405_static_2.csv.gz: 2."""
    return [part for part in sensor.split(".")[0].split("_") if part.isdigit()][-1]


def collect(folder):
    """What the page is made of: of each unit its verdict, effects and gap; what units share."""
    fleet = {}
    for name in fleets:
        for axis in "xyz":
            found = json.loads((Path(folder) / f"{name}_{axis}.json").read_text())
            fleet[f"{name}_{axis}"] = {
                "units": [{"unit": unit_name(each["sensor"]), "verdict": each["diagnosis"]["verdict"],
                           "effects": [e["effect"] for e in each["diagnosis"]["effects"]],
                           "bias_dps": each["diagnosis"]["baseline"]["parameters"]["c_dps"],
                           "noise_dps": each["diagnosis"]["baseline"]["parameters"]["measurement_noise_std_dps"],
                           "before": each["diagnosis"]["gap"]["before"], "after": each["diagnosis"]["gap"]["after"]}
                          for each in found["each"]],
                "shared": [{**one, "in": [unit_name(s) for s in one["in"]]} for one in found["shared"]]}
    (here / "fleet.json").write_text(json.dumps(fleet, indent=1) + "\n")


def who_has(units, effect):
    return [u["unit"] for u in units if effect in u["effects"]]


def units_table(fleet, name):
    lines = ["| unit | bias x, dps | y | z | white noise x, dps | y | z |", "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for i, unit in enumerate(fleet[f"{name}_x"]["units"]):
        axes = [fleet[f"{name}_{axis}"]["units"][i] for axis in "xyz"]
        numbers = [f"{a['bias_dps']:.3f}" for a in axes] + [f"{a['noise_dps']:.4f}" for a in axes]
        lines.append(f"| {unit['unit']} | {' | '.join(numbers)} |")
    return "\n".join(lines)


def effects_table(fleet, name):
    lines = ["| axis | all units | some units | one unit alone | gap before → after, median of units |",
             "| --- | --- | --- | --- | --- |"]
    for axis in "xyz":
        units = fleet[f"{name}_{axis}"]["units"]
        columns = {"all": [], "some": [], "one": []}
        for effect in sorted({e for u in units for e in u["effects"]}):
            with_it = who_has(units, effect)
            if len(with_it) == len(units):
                columns["all"].append(effect)
            else:
                columns["some" if len(with_it) > 1 else "one"].append(f"{effect} ({', '.join(with_it)})")
        before, after = (statistics.median(u[key] for u in units) for key in ("before", "after"))
        cells = ["; ".join(texts) or "–" for texts in columns.values()]
        lines.append(f"| {axis} | {' | '.join(cells)} | {before:.2f} → {after:.2f} |")
    return "\n".join(lines)


def interval(pair):
    return f" ({pair[0]:.3g} to {pair[1]:.3g})" if None not in pair else ""


def parameters_table(fleet, name):
    lines = ["| axis | effect | units | parameter | mean (95 %) | spread between units (95 %) | p, were all equal |",
             "| --- | --- | ---: | --- | ---: | ---: | ---: |"]
    for axis in "xyz":
        for one in fleet[f"{name}_{axis}"]["shared"]:
            for key, p in one["parameters"].items():
                if p["spread"] is None:
                    continue
                lines.append(f"| {axis} | {one['effect']} | {len(one['in'])} | {key} | {p['mean']:.4g}{interval(p['mean_interval'])} | "
                             f"{p['spread']:.3g}{interval(p['spread_interval'])} | {p['p_equal']:.2g} |")
    return "\n".join(lines) if len(lines) > 2 else "No parameter that two units share has an interval in each."


def main():
    if "--collect" in sys.argv[1:]:
        collect(sys.argv[sys.argv.index("--collect") + 1])
        return
    fleet = json.loads((here / "fleet.json").read_text())
    text = (here / "page.md").read_text()
    for name in fleets:
        text = text.replace("{{units %s}}" % name, units_table(fleet, name))
        text = text.replace("{{effects %s}}" % name, effects_table(fleet, name))
        text = text.replace("{{parameters %s}}" % name, parameters_table(fleet, name))
    target = here / "README.md"
    if "--check" in sys.argv[1:]:
        if target.read_text() != text:
            sys.exit(f"{target} is not what page.md and fleet.json make: run page.py")
        return
    target.write_text(text)


main()
