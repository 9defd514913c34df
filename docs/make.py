#!/usr/bin/env python3
"""Writes the reference pages, study.schema.json and the schema in formats.md from the program and sources.

    docs/make.py PROGRAM [--check]

A page's text is the comment above the plug-in's type, its numbers are those of `gyrostat list --json`.
With --check nothing is written; it fails where a file is not what would be written.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
REFERENCE = ROOT / "docs" / "reference"
# kind, its name for one, folder of the headers
KINDS = [("filters", "filter", "core/filters"),
         ("effects", "effect", "generators/effects"),
         ("lenses", "lens", "diagnosis/lenses"),
         ("metrics", "metric", "analysis/metrics"),
         ("temperatures", "temperature profile", "generators/environment/temperature"),
         ("motions", "motion profile", "generators/environment/motion"),
         ("accelerations", "acceleration profile", "generators/environment/acceleration")]


def camel(stem):
    return "".join(word.capitalize() for word in stem.split("_"))


def docstring(header, stem):
    """The comment above the plug-in's type, in paragraphs."""
    text = header.read_text()
    found = re.search(r"((?:^///.*\n)+)(?:template <.*>\n)?(?:struct|class|using) %s\b" % camel(stem), text, re.M)
    if not found:
        sys.exit(f"{header}: no comment above {camel(stem)}")
    lines = [line[3:].removeprefix(" ").rstrip() for line in found[1].splitlines()]
    return "\n".join(lines)


def number(value):
    return f"{value:g}"


def escaped(text):
    return text.replace("|", "\\|")


def example(kind, entry):
    values = {p["name"]: p["default"] for p in entry["parameters"]}
    if kind == "filters":
        return {"filter": entry["id"], "parameters": dict(list(values.items())[:4])} if values else entry["id"]
    if kind == "effects":
        return {"effect": entry["id"], **values}
    if kind in ("temperatures", "motions", "accelerations"):
        return {"profile": entry["id"], **values}
    return None


def header_of(folder, stem):
    """The plug-in's header; that of its family where it is a member, as pit_3 of pit."""
    header = f"{folder}/{stem}.hpp"
    return header if (ROOT / header).exists() else f"{folder}/{stem.rpartition('_')[0]}.hpp"


def page(kind, one, folder, entry):
    header = header_of(folder, entry["id"])
    facts = [f"{one}", f"[`{header}`](../../../{header})"]
    if entry.get("stage"):
        facts.append(f"acts at the stage *{entry['stage']}*")
    if entry.get("needs"):
        facts.append("needs " + ", ".join(f"`{name}`" for name in entry["needs"]))
    if "unit" in entry and entry["unit"] not in ("", "1"):
        facts.append(f"in {entry['unit']}")
    lines = [f"# {entry['id']}", "", entry["title"][:1].upper() + entry["title"][1:] + ".", "",
             " · ".join(facts), "", docstring(ROOT / header, Path(header).stem), ""]
    if entry["parameters"]:
        lines += ["| parameter | unit | range | default | meaning |", "| --- | --- | --- | ---: | --- |"]
        for p in entry["parameters"]:
            unit = "" if p["unit"] == "1" else p["unit"]
            lines.append(f"| `{p['name']}` | {unit} | {escaped(p['range'])} | {number(p['default'])} | "
                         f"{escaped(p['meaning'])} |")
        lines.append("")
    shown = example(kind, entry)
    if shown is not None:
        lines += ["In a study:", "", "```json", json.dumps(shown), "```", ""]
    lines += ["[All](../README.md) · [bibliography](../../bibliography.md)", ""]
    return "\n".join(lines)


def index(listed):
    lines = ["# Reference", "", "Made by `docs/make.py` from the headers and `gyrostat list --json`. Sources in brackets "
             "are those of the [bibliography](../bibliography.md). The keys of a study file are in "
             "[study.schema.json](../study.schema.json), which `gyrostat schema` prints.", ""]
    for kind, _, _ in KINDS:
        lines += [f"## {kind.capitalize()}", "", "| | |", "| --- | --- |"]
        lines += [f"| [{e['id']}]({kind}/{e['id']}.md) | {escaped(e['title'])} |" for e in listed[kind]]
        lines.append("")
    return "\n".join(lines)


def formats():
    """docs/formats.md with results/schema.sql between its marks."""
    text = (ROOT / "docs" / "formats.md").read_text()
    begin, end = "<!-- schema -->\n", "<!-- end of schema -->"
    schema = (ROOT / "results" / "schema.sql").read_text().strip()
    return f"{text[:text.index(begin)]}{begin}```sql\n{schema}\n```\n{text[text.index(end):]}"


def main():
    program = sys.argv[1]

    def said(*words):
        return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout

    listed = json.loads(said("list", "--json"))
    files = {REFERENCE / "README.md": index(listed), ROOT / "docs" / "study.schema.json": said("schema"),
             ROOT / "docs" / "formats.md": formats()}
    for kind, one, folder in KINDS:
        for entry in listed[kind]:
            files[REFERENCE / kind / f"{entry['id']}.md"] = page(kind, one, folder, entry)

    there = set(REFERENCE.rglob("*.md"))
    stale = [path for path, text in files.items() if not path.exists() or path.read_text() != text]
    surplus = sorted(there - set(files))
    if "--check" in sys.argv:
        for path in stale + surplus:
            print(f"{path.relative_to(ROOT)}: is not what docs/make.py makes")
        sys.exit(1 if stale or surplus else 0)
    for path in surplus:
        path.unlink()
    for path in stale:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(files[path])
    print(f"{len(files)} files, {len(stale)} written")


if __name__ == "__main__":
    main()
