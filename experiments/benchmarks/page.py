#!/usr/bin/env python3
"""Fills the numbers of results/published/performance/page.md from benchmarks.json and million.json into README.md.

    page.py FOLDER [--check]

With --check nothing is written; it fails where README.md is not what the two sources make.
Each benchmark's time is the least of its repetitions: other work on the machine only adds.
"""
import json
import re
import sys
from pathlib import Path

# Additions, multiplications, divisions and roots in NormalBlocks, of a pair of deviates: 33 in the
# radius, 34 in the turn, 2 products. Philox's integer operations are not counted.
OPERATIONS_PER_DEVIATE = 34.5


def least(runs):
    times = {}
    for run in runs:
        if run.get("run_type") != "iteration":
            continue
        name = re.sub(r"/(repeats:\d+|real_time|process_time)", "", run["name"])
        if name.startswith("diagnosis/") and run["real_time"] < times.get((name, "elapsed"), 1e9):
            times.update({(name, part): value for part, value in run.items() if isinstance(value, float)})
        for counter in ("s_per_trial_step", "s_per_deviate", "s_per_trial", "operations_per_s", "operations_per_step"):
            if counter in run:
                key = (name, counter)
                best = max if counter == "operations_per_s" else min
                times[key] = best(times.get(key, run[counter]), run[counter])
        unit = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}[run["time_unit"]]
        for what, value in [("elapsed", run["real_time"] * unit), ("processor", run["cpu_time"] * unit)]:
            times[name, what] = min(times.get((name, what), value), value)
    return times


def seconds(times, name):
    for counter in ("s_per_trial_step", "s_per_deviate", "s_per_trial"):
        if (name, counter) in times:
            return times[name, counter]
    raise SystemExit(f"no benchmark {name}")


def three(value):
    digits = 2 if value < 10 else 1 if value < 100 else 0
    return f"{value:.{digits}f}"


def operations(times, name):
    if name.startswith("normals/"):
        return OPERATIONS_PER_DEVIATE
    return times["/".join(name.split("/")[:2]) + "/one", "operations_per_step"]


def fraction(times, name):
    target = name.split("/")[2 if name.startswith("filter/") else 1]
    done = operations(times, name) / seconds(times, name)
    return f"{100 * done / times['peak/' + target, 'operations_per_s']:.0f} %"


def filter_table(times):
    lines = ["| filter | operations a step | one at a time | packed, least of all | ratio | lanes | of the peak |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for one in sorted(n for n, c in times if n.endswith("/one") and c == "s_per_trial_step"):
        stem = one[:-len("/one")]
        packed = [n for n, c in times if n.startswith(stem + "/") and n != one and c == "s_per_trial_step"]
        best = min(packed, key=lambda n: seconds(times, n))
        _, filter_id, target, lanes = best.split("/")
        lines.append(f"| {filter_id} | {operations(times, best):.0f} | {three(1e9 * seconds(times, one))} ns "
                     f"| {three(1e9 * seconds(times, best))} ns | {seconds(times, one) / seconds(times, best):.1f} "
                     f"| {lanes}, {target} | {fraction(times, best)} |")
    return "\n".join(lines)


def target_table(times):
    columns = sorted({n.split("/", 2)[2] for n, c in times
                      if n.startswith("filter/") and c == "s_per_trial_step" and not n.endswith("/one")},
                     key=lambda c: (["SSE2", "AVX2", "AVX-512"].index(c.split("/")[0]), int(c.split("/")[1])))
    lines = ["| ns per trial and step | " + " | ".join(c.replace("/", ", ") for c in columns) + " |",
             "| --- |" + " --- |" * len(columns)]
    for one in sorted(n for n, c in times if n.endswith("/one") and c == "s_per_trial_step"):
        stem = one[:-len("/one")]
        lines.append(f"| {stem.split('/')[1]} | "
                     + " | ".join(three(1e9 * seconds(times, f"{stem}/{c}")) for c in columns) + " |")
    return "\n".join(lines)


def diagnosis_table(times):
    """Seconds of each part, one column a recording, the longest part first."""
    names = sorted({n for n, _ in times if n.startswith("diagnosis/")})
    own = {"real_time", "cpu_time", "elapsed", "processor", "peak_MiB"}
    parts = sorted({c for n, c in times if n == names[0]} - own, key=lambda c: -times[names[0], c])
    lines = ["| part | " + " | ".join(n.split("/")[1] + " [s]" for n in names) + " |", "| --- |" + " ---: |" * len(names)]
    for part in parts:
        lines.append(f"| {part} | " + " | ".join(f"{times.get((n, part), 0.0):.1f}" for n in names) + " |")
    lines.append("| all | " + " | ".join(f"{times[n, 'elapsed']:.1f}" for n in names) + " |")
    return "\n".join(lines)


def million_text(run):
    """A study of a million trials as `gyrostat plan` foretold it and as it then ran."""
    share = run["elapsed_s"] / run["planned_s"] - 1.0
    return (f"{run['filters']} filters over {run['samples']:,} samples, {run['trials']:,} trials: `gyrostat plan` foretold "
            f"{run['planned_s']:.0f} s and {run['planned_GB']:.2f} GB, the run took {run['elapsed_s']:.0f} s "
            f"({100 * share:+.0f} %) and {run['stored_GB']:.2f} GB, tables and outcomes.csv.gz included. Its largest memory was "
            f"{run['peak_MB']:.0f} MB; a run of {run['fewer_trials']:,} trials took {run['fewer_peak_MB']:.0f} MB.")


def fill(text, times, million):
    def value(match):
        what, *names = match.group(1).split()
        if what == "filters":
            return filter_table(times)
        if what == "targets":
            return target_table(times)
        if what == "diagnosis":
            return diagnosis_table(times)
        if what == "million":
            return million_text(million)
        if what == "counter":
            return f"{times[names[0], names[1]]:.0f}"
        if what == "ms":
            return three(1e3 * times[names[0], "processor"]) + " ms"
        if what == "elapsed":
            return three(times[names[0], "elapsed"]) + " s"
        if what == "gain":
            return f"{times[names[0], 'elapsed'] / times[names[1], 'elapsed']:.2f}"
        if what == "rate":
            return f"{float(names[1]) / times[names[0], 'elapsed']:,.0f}"
        if what == "ns":
            return three(1e9 * seconds(times, names[0])) + " ns"
        if what == "us":
            return three(1e6 * seconds(times, names[0])) + " µs"
        if what == "ratio":
            return f"{seconds(times, names[0]) / seconds(times, names[1]):.2f}"
        if what == "millions":
            return f"{1e-6 / seconds(times, names[0]):.0f} million"
        if what == "giga":
            return f"{1e-9 * times[names[0], 'operations_per_s']:.1f} · 10⁹"
        if what == "fraction":
            return fraction(times, names[0])
        raise SystemExit(f"page.md: {match.group(0)}")
    return re.sub(r"\{\{([^}]*)\}\}", value, text)


def main():
    folder = Path(sys.argv[1])
    times = least(json.loads((folder / "benchmarks.json").read_text())["benchmarks"])
    million = json.loads((folder / "million.json").read_text())
    page = fill((folder / "page.md").read_text(), times, million)
    readme = folder / "README.md"
    if "--check" not in sys.argv:
        readme.write_text(page)
    elif readme.read_text() != page:
        raise SystemExit(f"{readme} is not what page.md, benchmarks.json and million.json make")


if __name__ == "__main__":
    main()
