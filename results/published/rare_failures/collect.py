#!/usr/bin/env python3
"""Makes the page's tables of what `gyrostat failure --how` and `gyrostat rank --metric failure` tell as JSON,
the arguments: of each cell how likely, levels and ranking, and what drives the failures, a row a cell and method."""
import json
import sys

SECOND = "importance sampling along it"
tables, names, drivers, opinions = [], [], {}, []
for table in [table for file in sys.argv[1:] for table in json.load(open(file))]:
    cell, what = table["title"].split(": ", 1)
    if what.startswith("how likely"):
        names.append(cell)
    elif what.startswith("levels"):
        names.append(cell + "_levels")
    elif what.startswith("ranking"):
        names.append(cell + "_ranking")
    else:
        method = what.split()[1]
        drivers[cell, method] = dict(table["rows"])
        opinions += [[cell, method, note.removeprefix(SECOND).lstrip(": ")] for note in table["notes"]
                     if note.startswith(SECOND)]
        continue
    tables.append(table)

inputs = sorted({name for shares in drivers.values() for name in shares})
names.append("drivers")
tables.append({"title": "What drives the failures: shares of the design point",
               "columns": [{"name": "cell", "unit": ""}, {"name": "method", "unit": ""},
                           *({"name": name, "unit": "%"} for name in inputs)],
               "rows": [[*key, *(shares.get(name, 0.0) for name in inputs)] for key, shares in drivers.items()],
               "notes": []})
names.append("second_opinion")
tables.append({"title": "What importance sampling along the design point says",
               "columns": [{"name": name, "unit": ""} for name in ("cell", "method", "probability (95 %), by how many more trials")],
               "rows": opinions, "notes": []})
json.dump({"names": names, "tables": tables}, sys.stdout, indent=1, ensure_ascii=False)
print()
