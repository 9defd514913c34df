"""docs/python.md, block by block.

    check_python_page.py PROGRAM ROOT
"""
import os
import sys

from blocks import SMALL_STUDY, Folder, blocks_of, skip_without

skip_without("numpy", "pandas")
program, root = sys.argv[1:3]
with Folder(program) as folder:
    (folder.path / "small.json").write_text(SMALL_STUDY)
    os.chdir(folder.path)
    names = {}
    blocks = blocks_of(f"{root}/docs/python.md", "sh", "python")
    for language, text in blocks:
        if language == "sh":
            folder.shell(text)
        else:
            exec(compile(text, "docs/python.md", "exec"), names)

    # The page's own comparison could be empty: the export is what the program prints, and is all of it.
    exported = folder.shell("gyrostat export runs/small").splitlines()
    stored = names["stored"]
    assert len(stored) == len(exported) - 1 == 12 * 4 + 5 * 2, len(stored)
    assert exported[0].split(",") == list(stored.columns)
    assert sorted(set(stored.method)) == ["kf", "kf_ma", "none", "oracle", "stf_1.05"]
    assert len(blocks) >= 6
print("the blocks of docs/python.md ran, and agree with gyrostat export")
