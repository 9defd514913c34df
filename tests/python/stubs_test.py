"""The stub of the library names what is in it; everything public has a docstring."""
import ast
import inspect
import os
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("SKIPPED: needs Debian's python3-numpy")
    sys.exit(0)

import gyrostat
from gyrostat import _library


def names_of(body):
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            yield node.name, node
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id, None


def public(owner):
    return {name for name in vars(owner) if not name.startswith("_")}


stub = ast.parse((Path(os.environ["GYROSTAT_SOURCE_DIR"]) / "python/gyrostat/_library.pyi").read_text())
stubbed = dict(names_of(stub.body))
assert set(stubbed) == public(_library), set(stubbed) ^ public(_library)
for name, node in stubbed.items():
    if isinstance(node, ast.ClassDef) and name != "Error":
        members = {member for member, _ in names_of(node.body) if not member.startswith("_")}
        assert members == public(getattr(_library, name)), (name, members ^ public(getattr(_library, name)))

for name in gyrostat.__all__:
    assert inspect.getdoc(getattr(gyrostat, name)), f"gyrostat.{name} has no docstring"
    if inspect.isfunction(getattr(gyrostat, name)):
        signature = inspect.signature(getattr(gyrostat, name))
        untyped = [p.name for p in signature.parameters.values() if p.annotation is p.empty]
        assert not untyped and signature.return_annotation is not signature.empty, (name, untyped)
print(f"{len(stubbed)} names of the library are in its stub; {len(gyrostat.__all__)} public ones have docstrings and types")
