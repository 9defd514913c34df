"""docs/formats.md names every column and key that the program writes, and no other.

    check_formats.py PROGRAM ROOT
"""
import csv
import gzip
import json
import re
import sqlite3
import sys
from pathlib import Path

from blocks import SMALL_STUDY, Folder

program, root = sys.argv[1:3]
page = (Path(root) / "docs" / "formats.md").read_text()
sections = {part.split("\n")[0]: part for part in re.split(r"^## ", page, flags=re.M)[1:]}
failures = []


def documented(section, table_row=None):
    """Names in backquotes in a section; of the row that begins with `table_row` alone, where given."""
    text = sections[section]
    if table_row:
        text = next(line for line in text.splitlines() if line.startswith(f"| `{table_row}`"))
    return re.findall(r"`([^`]+)`", text)


def same(what, written, told):
    if set(written) != set(told):
        failures.append(f"{what}: written {sorted(set(written) - set(told))} but not documented, "
                        f"documented {sorted(set(told) - set(written))} but not written")


with Folder(program) as folder:
    (folder.path / "small.json").write_text(SMALL_STUDY)
    run = lambda script: folder.shell(script)
    run("gyrostat run small.json")
    run("gyrostat simulate small.json --cell still --out rec.csv")
    run("gyrostat apply rec.csv --out comp.csv")

    with gzip.open(folder.path / "runs/small/outcomes.csv.gz", "rt") as file:
        columns = next(csv.reader(file))
    metrics = [m["id"] for m in json.loads(run("gyrostat list metrics --json"))]
    told = [n for line in sections["outcomes.csv.gz"].splitlines() if line.startswith("| `")
            for n in re.findall(r"`([^`]+)`", line.split("|")[1])]
    same("outcomes.csv", columns, told + metrics)

    tables = json.loads((folder.path / "runs/small/tables.json").read_text())
    same("tables.json", tables[0], ["title", "columns", "rows", "notes"])
    same("tables.json, columns", tables[0]["columns"][0], ["name", "unit"])

    with open(folder.path / "comp.csv") as file:
        columns = next(csv.reader(file))
    told = [n for line in sections["apply --out"].splitlines() if line.startswith("| `")
            for n in re.findall(r"`([^`]+)`", line.split("|")[1])]
    same("apply", [re.sub(r"^kf_(?=estimate|innovation|status)", "<id>_", c) for c in columns
                   if c in ("t_s", "raw_dps") or c.startswith(("kf_estimate", "kf_innovation", "kf_status"))], told)

    steps = run("gyrostat replay small:still:3:kf --steps").splitlines()[0].split(",")
    same("replay --steps", steps, re.findall(r"`([^`]+)`", sections["replay --steps"]))

    (folder.path / "long.json").write_text(
        '{"cells": [{"scenario": {"duration_s": 60, "rate_hz": 20, "effects": [{"effect": "outliers"}]}}]}')
    run("gyrostat simulate long.json --out long.csv && gyrostat diagnose long.csv --json gap.json")
    diagnosis = json.loads((folder.path / "gap.json").read_text())
    rows = [line for line in sections["diagnose --json"].splitlines() if line.startswith("| `")]
    same("diagnose", diagnosis, [n for line in rows for n in re.findall(r"`([^`]+)`", line.split("|")[1])])
    for key in ("recording", "gap", "next_experiment"):
        same(f"diagnose, {key}", diagnosis[key], documented("diagnose --json", key)[1:])
    same("diagnose, causes", diagnosis["causes"][0], documented("diagnose --json", "causes")[1:])
    same("diagnose, transfer", diagnosis["transfer"][0], documented("diagnose --json", "transfer")[1:])

    events = {}
    for line in (folder.path / "runs/small/log.jsonl").read_text().splitlines():
        entry = json.loads(line)
        events.setdefault(entry["event"], set()).update(set(entry) - {"time", "event"})
    for event, keys in events.items():
        if not keys <= set(documented("log.jsonl", event)):
            failures.append(f"log.jsonl, {event}: {keys} not all documented")
    assert {"start", "cell", "end"} <= set(events)

    # The SQL of the page makes the tables that a store has.
    written = sqlite3.connect(folder.path / "runs/small/store.db")
    told = sqlite3.connect(":memory:")
    told.executescript(re.search(r"```sql\n(.*?)```", page, re.S)[1])
    for database_table in [name for (name,) in written.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]:
        columns = [db.execute(f"PRAGMA table_info({database_table})").fetchall() for db in (written, told)]
        if columns[0] != columns[1]:
            failures.append(f"store.db: table {database_table} differs")

print("\n".join(failures) or "docs/formats.md and the files agree")
sys.exit(1 if failures else 0)
