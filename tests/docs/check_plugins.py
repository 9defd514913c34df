"""docs/plugins.md, block by block, beside the examples that it is about: they keep the contract, rank beside ours, and
give the same bytes again for one thread and for two.

    check_plugins.py PROGRAM ROOT [INCLUDE]     INCLUDE: where gyrostat_plugin.h is; else in the tree
"""
import os
import re
import shutil
import sys
from pathlib import Path

from blocks import Folder

program, root = sys.argv[1:3]
include = sys.argv[3] if len(sys.argv) > 3 else f"{root}/experiments/plugins"
page = Path(f"{root}/docs/plugins.md").read_text()
for tool in ("cc", "c++"):
    if not shutil.which(tool):
        print(f"SKIPPED: needs {tool}")
        sys.exit(0)

with Folder(program) as folder:
    shutil.copytree(f"{root}/examples/plugins", folder.path, dirs_exist_ok=True)
    folder.environment |= {"C_INCLUDE_PATH": include, "CPLUS_INCLUDE_PATH": include,
                           "CFLAGS": "", "PYTHONDONTWRITEBYTECODE": "1"}
    has_rust = shutil.which("rustc") is not None
    outputs = []
    for name, text in re.findall(r"^```sh( rust)?\n(.*?)^```$", page, re.M | re.S):
        if not name or has_rust:
            outputs.append(folder.shell(text))
    assert len(outputs) >= 5 and "BROKEN" not in "".join(outputs), outputs
    assert outputs[0].count("kept") == 7, outputs[0]

    # What is listed and ranked are these, beside ours.
    methods = ["cpp_mean", "coder_mean", "python_mean", "c_mean", "kf", "none", "oracle"]
    for method in methods:
        assert f"\n  {method} " in outputs[-1], (method, outputs[-1])

    # The same filter in four languages has the same numbers; C's own, of another memory, has others.
    options = ("--plugin c_mean.so --plugin cpp_mean.so --plugin coder_mean.so --plugin popcorn.so "
               '--filter-command "python3 leaky_mean.py"')
    study = (folder.path / "study.json").read_text()
    if has_rust:
        options += " --plugin rust_mean.so"
        study = study.replace('"python_mean"', '"python_mean", "rust_mean"')
        (folder.path / "study.json").write_text(study)
    exports = []
    for threads in (1, 2, 1):
        shutil.rmtree(folder.path / "runs")
        folder.shell(f"gyrostat run study.json --threads {threads} {options}")
        tables = (folder.path / "runs/study/outcomes.csv.gz").read_bytes()
        exports.append((folder.shell(f"gyrostat export runs/study"), tables))
    assert exports[0] == exports[1] == exports[2]
    rows = [line.split(",", 3) for line in exports[0][0].splitlines()[1:]]
    by_method = {method: [rest for _, _, name, rest in rows if name == method]
                 for method in methods + ["rust_mean"] * has_rust}
    assert len(by_method["kf"]) == 40
    for method in ["coder_mean", "python_mean"] + ["rust_mean"] * has_rust:
        assert by_method[method] == by_method["cpp_mean"], method
    assert by_method["c_mean"] != by_method["cpp_mean"]

    # A design over a plug-in's parameters, an effect's and a filter's; a report that replays its trials.
    swept = study.replace('"filters": [', '"parameters_from": "truth", "design": {"kind": "grid", "parameters": {'
                          '"scenario.effects.popcorn.step_dps": [0, 0.1], '
                          '"filters.c_mean.parameters.time_constant": [10, 100]}}, "filters": [')
    (folder.path / "swept.json").write_text(swept.replace('"trials": 40', '"trials": 4'))
    assert "time_constant" in folder.shell(f"gyrostat run swept.json {options}")
    page = folder.shell(f"gyrostat report runs/study {options} && cat runs/study/report.html")
    assert "python_mean" in page
    trial = folder.shell(f"gyrostat replay 'study:at rest:3:python_mean' --steps {options}")
    assert len(trial.splitlines()) >= 1000, trial[:500]
    job = folder.shell(f"gyrostat slurm study.json {options} && cat study.sbatch")
    assert "--filter-command 'python3 leaky_mean.py'" in job and f"--plugin '{folder.path}/c_mean.so'" in job, job

    # On a recording: what fails is left out, the others are there.
    folder.shell(f"gyrostat simulate study.json --out rec.csv {options}")
    applied = folder.shell("printf '%s\\n' 'import sys' 'print(\"{\\\"protocol\\\": 1, \\\"name\\\": \\\"lazy\\\"}\", flush=True)'"
                           " 'sys.stdin.buffer.read(16)' '1 / 0' > lazy.py; "
                           f"gyrostat apply rec.csv --plugin c_mean.so --filter-command 'python3 lazy.py' 2>&1")
    assert "lazy left out: lazy" in applied and "ZeroDivisionError: division by zero" in applied, applied
    assert "\n  c_mean " in applied and "\n  kf " in applied, applied
print("the examples keep the contract and rank beside ours")
