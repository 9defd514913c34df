"""The examples in the docstrings of public headers compile.

    check_examples.py ROOT WORK COMPILER [OPTION...]

A docstring's line "Example: ..." is followed by a blank line and an indented block. Each block
becomes a namespace of one source file: its templates and classes first, the rest inside a function. The
source includes every header that has an example, so that a block needs no more than it shows.
"""
import re
import subprocess
import sys
from pathlib import Path

ROOT, WORK, COMPILER = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:]
ROOMS = ["core", "generators", "analysis", "results", "recordings", "diagnosis", "experiments"]

# What a user of the library meets first. Each says by an example how it is used.
ENTRY_POINTS = """
core/series.hpp core/filter_type.hpp core/track.hpp core/random.hpp
generators/scenario.hpp generators/effect.hpp
analysis/fits/arima_fit.hpp analysis/fits/arima_innovations.hpp analysis/fits/arima_intervals.hpp
analysis/fits/arima_likelihood.hpp analysis/fits/arima_moments.hpp analysis/fits/thermal_regression.hpp
analysis/spectra/allan.hpp analysis/calibration.hpp
analysis/statistics/summary.hpp analysis/statistics/paired.hpp analysis/statistics/all_pairs.hpp
results/store.hpp results/render/render.hpp recordings/recording.hpp diagnosis/diagnosis.hpp
experiments/study/study.hpp experiments/run/runner.hpp experiments/findings/ranking.hpp
""".split()

def examples(text):
    """(line, block) of every example in a header."""
    lines = [re.sub(r"^\s*///", "", line) if re.match(r"\s*///", line) else None for line in text.split("\n")]
    at = 0
    while at < len(lines):
        if lines[at] is None or not lines[at].startswith(" Example:"):
            at += 1
            continue
        while lines[at] is not None and lines[at].strip():  # the sentence
            at += 1
        first, block = at + 2, []
        at += 1
        while at < len(lines) and lines[at] is not None and (not lines[at].strip() or lines[at].startswith("   ")):
            block.append(lines[at][3:])
            at += 1
        yield first, "\n".join(block).strip("\n")


def parts(block):
    """What goes before the namespace, what into it, and what into its function."""
    lines = block.split("\n")
    includes = [line for line in lines if line.startswith("#include")]
    lines = ["" if line.startswith("#include") else line for line in lines]
    end = 0
    if any(re.match(r"(template|struct|class)\b", line) for line in lines):
        end = max(i for i, line in enumerate(lines) if line == "};") + 1
    return includes, "\n".join(lines[:end]), "\n".join(lines[end:])


headers = {}
for room in ROOMS:
    for header in sorted((ROOT / room).rglob("*.hpp")):
        found = list(examples(header.read_text()))
        if found:
            headers[header.relative_to(ROOT).as_posix()] = found
without = [header for header in ENTRY_POINTS if header not in headers]
if without:
    sys.exit("no example in " + ", ".join(without))

includes = ["#include <cstdio>"] + [f"#include <gyrostat/{header}>" for header in headers]
body = ""
for number, (header, line, block) in enumerate((h, n, b) for h, found in headers.items() for n, b in found):
    own_includes, declarations, statements = parts(block)
    includes += own_includes
    if not (declarations or statements.strip()):
        sys.exit(f"{header}:{line}: an example without a line")
    body += (f'namespace example_{number} {{\nusing namespace gyrostat;\n#line {line} "{header}"\n{declarations}\n'
             f'[[maybe_unused]] void run() {{\n'
             f'#line {line + declarations.count(chr(10)) + bool(declarations)} "{header}"\n{statements}\n}}\n}}\n')

WORK.mkdir(parents=True, exist_ok=True)
source = WORK / "examples.cpp"
source.write_text("\n".join(includes) + "\n\n" + body)
compiled = subprocess.run([*COMPILER, "-fsyntax-only", str(source)], capture_output=True, text=True)
if compiled.returncode:
    sys.exit(compiled.stderr)
print(f"{sum(map(len, headers.values()))} examples of {len(headers)} headers compile")
