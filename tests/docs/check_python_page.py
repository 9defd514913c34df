"""docs/python.md, block by block: what needs no package, and where it is built what needs it.

    check_python_page.py PROGRAM ROOT
"""
import os
import sys
from pathlib import Path

from blocks import SMALL_STUDY, Folder, blocks_of, skip_without

skip_without("numpy", "pandas")
try:
    import gyrostat  # noqa: F401
    has_package = True
except ImportError:
    has_package = False
program, root = sys.argv[1:3]
with Folder(program) as folder:
    (folder.path / "small.json").write_text(SMALL_STUDY)
    os.chdir(folder.path)

    def run(part):
        page = folder.path / "part.md"
        page.write_text(part)
        names = {}
        blocks = blocks_of(page, "sh", "python")
        for language, text in blocks:
            if language == "sh":
                folder.shell(text)
            else:
                exec(compile(text, "docs/python.md", "exec"), names)
        return names, len(blocks)

    with_package, without = Path(f"{root}/docs/python.md").read_text().split("\n## Without the package\n")
    if has_package:
        cell = {"name": "a", "trials": 1, "filters": ["none"], "scenario": {"duration_s": 30, "rate_hz": 50}}
        gyrostat.simulate({"cells": [cell]}).write("REC.csv")
        names, count = run(with_package)
        assert count >= 6 and len(names["recording"]) == 1500, count
        assert set(names["gyrostat"].Run("runs/with_mine").outcomes()["method"]) >= {"forgetting", "slow", "kf"}
    names, count = run(without)

    # The page's own comparison could be empty: the export is what the program prints, and is all of it.
    exported = folder.shell("gyrostat export runs/small").splitlines()
    stored = names["stored"]
    assert len(stored) == len(exported) - 1 == 12 * 4 + 5 * 2, len(stored)
    assert exported[0].split(",") == list(stored.columns)
    assert sorted(set(stored.method)) == ["kf", "kf_ma", "none", "oracle", "stf_1.05"]
    assert count >= 6, count
print("the blocks of docs/python.md ran", "" if has_package else "(those of the package not: it is not built)")
