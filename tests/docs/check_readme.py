"""README.md as a newcomer types it: commands with what they show, to the letter.

    check_readme.py PROGRAM ROOT
"""
import sys
from pathlib import Path

from blocks import Folder, blocks_of

program, root = sys.argv[1], Path(sys.argv[2]).resolve()
blocks = blocks_of(root / "README.md", "sh", "text")
compared = 0
with Folder(program) as folder:
    (folder.path / "experiments").symlink_to(root / "experiments")
    for (language, commands), (after, shown) in zip(blocks, blocks[1:]):
        if (language, after) != ("sh", "text"):
            continue
        said = folder.shell(commands)
        if said != shown:
            sys.exit(f"README.md shows\n{shown}\nand the commands print\n{said}")
        assert max(map(len, said.splitlines())) <= 80, "wider than a screen"
        compared += 1
assert compared >= 1, "README.md shows no output"
print(f"{compared} outputs are what the program prints")
