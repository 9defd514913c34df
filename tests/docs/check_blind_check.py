"""docs/blind_check.md: its check is one, its commands make, answer and score it, and its forms are those that there are.

    check_blind_check.py PROGRAM ROOT
"""
import json
import re
import sys
from pathlib import Path

from blocks import Folder, blocks_of

program, root = sys.argv[1:3]
page = Path(root) / "docs" / "blind_check.md"
(_, check), = blocks_of(page, "json")
(_, commands), = blocks_of(page, "sh")
with Folder(program) as folder:
    (folder.path / "CHECK.json").write_text(check)
    said = folder.shell(commands)
    recordings = list((folder.path / "FOLDER/recordings").glob("*.csv.gz"))
    answers = list((folder.path / "ANSWERS").glob("*.json"))
    assert len(recordings) == len(answers) == 13, (len(recordings), len(answers))
    assert "have no diagnosis" not in said and "sets of effects" in said, said
    without = json.loads((folder.path / "FOLDER/without.json").read_text())
    assert list(without.values()) == [["bias_instability"]] * 2, without

forms = page.read_text().split("| form | of | |\n")[1].split("\n\n")[0]
told = set(re.findall(r"^\| `(\w+)`", forms, re.M))
there = {path.stem for path in (Path(root) / "experiments/blind/forms").glob("*.hpp")}
assert told == there, told ^ there
