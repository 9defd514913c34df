"""docs/study.schema.json against the program: what is committed passes, and where it refuses, so does
the program.

    check_schema.py PROGRAM ROOT
"""
import copy
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("SKIPPED: needs Debian's python3-jsonschema")
    sys.exit(0)

PROGRAM, ROOT = sys.argv[1], Path(sys.argv[2])
SCHEMA = json.loads((ROOT / "docs" / "study.schema.json").read_text())
jsonschema.Draft7Validator.check_schema(SCHEMA)
VALIDATOR = jsonschema.Draft7Validator(SCHEMA)
failures = []


def require(holds, what):
    if not holds:
        failures.append(what)


def complaints(study):
    """What `validate` says about a study: exit code and lines."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "s.json"
        path.write_text(json.dumps(study))
        done = subprocess.run([PROGRAM, "validate", str(path)], capture_output=True, text=True)
        return done.returncode, done.stderr.splitlines()


def committed_studies():
    for path in [*ROOT.glob("experiments/studies/*.json"), *ROOT.glob("results/published/*/*.study.json")]:
        study = json.loads(path.read_text())
        if isinstance(study, dict) and "cells" in study:
            yield path, study
    for page in ("README.md", "docs/tutorial.md"):
        if not (ROOT / page).exists():
            continue
        for block in (ROOT / page).read_text().split("```json\n")[1:]:
            study = json.loads(block.split("```")[0])
            if "cells" in study:
                yield page, study


count = 0
for path, study in committed_studies():
    count += 1
    for error in VALIDATOR.iter_errors(study):
        failures.append(f"{path}: {error.json_path}: {error.message[:200]}")
require(count > 10, f"{count} committed studies")

SOUND = {"title": "sound", "seed": 1, "cells": [{"name": "a", "trials": 2, "filters": ["none", "kf"], "scenario":
         {"duration_s": 10, "rate_hz": 50}}]}
require(VALIDATOR.is_valid(SOUND) and complaints(SOUND)[0] == 0, "the sound study is refused")
WITH_SCHEMA = {"$schema": "study.schema.json", **SOUND}
require(VALIDATOR.is_valid(WITH_SCHEMA) and complaints(WITH_SCHEMA)[0] == 0, "$schema is refused")


def both_refuse(study, what, lines=1):
    code, said = complaints(study)
    require(not VALIDATOR.is_valid(study), f"the schema takes {what}")
    # Of very many, the last line says how many more there are.
    more = re.search(r"(\d+) more", said[-1]) if said else None
    told = len(said) - 1 + int(more[1]) if more else len(said)
    require(code == 2 and told == lines, f"the program on {what}: {code}, {told} lines, not {lines}: {said[:3]}")


def mutated(path, value):
    study = copy.deepcopy(SOUND)
    at = study
    for key in path[:-1]:
        if isinstance(at, dict):
            at = at.setdefault(key, {})
        else:
            at = at[key]
    if isinstance(at, list):
        at[path[-1]:] = [value]
    else:
        at[path[-1]] = value
    return study


CELL = ["cells", 0]
SCENARIO = [*CELL, "scenario"]
for path, value in [
        (["sed"], 1), (["title"], 1), (["seed"], -1), (["seed"], 1.5), (["cells"], []), (["cells"], {}),
        (["failure_budget"], 2), ([*CELL, "trials"], 0), ([*CELL, "trials"], "10"), ([*CELL, "trial"], 3),
        ([*CELL, "filters"], []), ([*CELL, "filters"], ["kv"]), ([*CELL, "filters", 1], 7),
        ([*CELL, "filters", 1], {"filter": "kf", "params": {}}), ([*CELL, "filters", 1], {"parameters": {}}),
        ([*CELL, "filters", 1], {"filter": "stf", "parameters": {"forgetting": 2}}),
        ([*CELL, "filters", 1], {"filter": "stf", "parameters": {"fading": 2}}),
        ([*CELL, "filters", 1], {"filter": "stf", "tune": {"forgetting": [0.1]}}),
        ([*CELL, "filters", 1], {"filter": "stf", "tune": {"forgetting": [0.1, 7]}}),
        ([*CELL, "filters", 1], {"filter": "kf", "parameters_from": "guess"}),
        ([*CELL, "filters", 1], {"filter": "kf", "id": "a,b"}), ([*CELL, "name"], 'a"b'),
        ([*CELL, "calibration"], {"fit": "least"}), ([*CELL, "tuning"], {"metric": "rms"}),
        ([*CELL, "assumed"], {"delta1": 2}), ([*CELL, "denoise"], 0.5), ([*CELL, "parameters_from"], "defaults"),
        ([*CELL, "pieces"], {}), ([*CELL, "grid"], {"trials": 3}),
        ([*SCENARIO, "durations"], 1), ([*SCENARIO, "duration_s"], 0), ([*SCENARIO, "rate_hz"], None),
        ([*SCENARIO, "motion"], {"profile": "spin"}), ([*SCENARIO, "motion"], {}),
        ([*SCENARIO, "temperature"], {"profile": "cycle", "period_s": 0}),
        ([*SCENARIO, "temperature"], {"profile": "cycle", "period": 10}),
        ([*SCENARIO, "compass"], {"noise": 1}), ([*SCENARIO, "compass"], {"disturbances": [{"start_s": -1}]}),
        ([*SCENARIO, "from_recording"], {"axis": "x"}), ([*SCENARIO, "from_fleet"], {"fil": "fleet.json"}),
        ([*SCENARIO, "effects"], [{"effect": "outlier"}]),
        ([*SCENARIO, "random_error"], {"phi": 1}), ([*SCENARIO, "random_error"], [])]:
    both_refuse(mutated(path, value), f"{'.'.join(map(str, path))} = {json.dumps(value)}")


def beyond(schema):
    """A number just beyond each bound of a numeric schema."""
    if "minimum" in schema:
        yield schema["minimum"] - 1
    if "exclusiveMinimum" in schema:
        yield schema["exclusiveMinimum"]
    if "maximum" in schema:
        yield schema["maximum"] * 2 + 1
    if "exclusiveMaximum" in schema:
        yield schema["exclusiveMaximum"]
    if schema["type"] == "integer":
        yield 0.5


# Every bound of every parameter of every effect and filter: as many lines as mistakes.
bounds = 0
listed = json.loads(subprocess.run([PROGRAM, "list", "--json"], capture_output=True, text=True).stdout)
rules = {rule["if"]["properties"]["effect"]["const"]: rule["then"]["properties"] for rule in
         SCHEMA["definitions"]["scenario"]["properties"]["effects"]["items"]["allOf"]}
require(set(rules) == {e["id"] for e in listed["effects"]}, "effects of the schema and of the program differ")
effects = []
for name, properties in rules.items():
    for parameter, schema in properties.items():
        if parameter != "effect":
            effects += [{"effect": name, parameter: value} for value in beyond(schema)]
both_refuse(mutated([*SCENARIO, "effects"], effects), "parameters of effects", len(effects))
for effect in effects:
    require(not VALIDATOR.is_valid(mutated([*SCENARIO, "effects"], [effect])), f"the schema takes {effect}")
filters = []
for entry in listed["filters"]:
    properties = SCHEMA["definitions"]["parameters_of_" + entry["id"]]["properties"]
    require(set(properties) == {p["name"] for p in entry["parameters"]}, f"parameters of {entry['id']} differ")
    for parameter, schema in properties.items():
        filters += [{"id": f"m{len(filters) + k}", "filter": entry["id"], "parameters": {parameter: value}}
                    for k, value in enumerate(beyond(schema))]
both_refuse(mutated([*CELL, "filters"], filters), "parameters of filters", len(filters))
for method in filters:
    require(not VALIDATOR.is_valid(mutated([*CELL, "filters"], [method])), f"the schema takes {method}")

print(f"{count} committed studies pass; {len(effects)} + {len(filters)} values out of range refused by both")
print("\n".join(failures))
sys.exit(1 if failures else 0)
