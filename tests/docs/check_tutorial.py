"""docs/tutorial.md from a clean folder: its commands in order, and what it says they show.

    check_tutorial.py PROGRAM ROOT
"""
import json
import sys
from pathlib import Path

from blocks import Folder, blocks_of

program, root = sys.argv[1:3]
page = Path(root) / "docs" / "tutorial.md"
with Folder(program) as folder:
    verbs = folder.shell("gyrostat --help")
    ran, said = 0, ""
    for _, text in blocks_of(page, "sh"):
        if "gyrostat report" in text and "\n  report " not in verbs:
            print("SKIPPED the step `report`: this build has no such verb")
            continue
        said += folder.shell(text)
        ran += 1
    assert ran >= 7, ran

    diagnosis = json.loads((folder.path / "gap.json").read_text())
    told = page.read_text()
    assert f"the verdict is `{diagnosis['verdict']}`" in told, diagnosis["verdict"]
    assert diagnosis["gap"]["p_before"] < 0.05
    assert diagnosis["gap"]["after"] < diagnosis["gap"]["before"]

    def errors(run):
        """Mean bias RMSE of each method that does not know the truth."""
        rows = [row.split(",") for row in folder.shell(f"gyrostat export runs/{run}").splitlines()]
        of, at = rows[0].index("method"), rows[0].index("bias_rmse")
        methods = {row[of] for row in rows[1:]} - {"oracle"}
        return {m: sum(float(row[at]) for row in rows[1:] if row[of] == m) / sum(row[of] == m for row in rows[1:])
                for m in methods}

    for run, least, most in (("around", 1.05, 1.2), ("with_likelihood", 1.05, float("inf")), ("with_moments", 0.95, 1.05)):
        error = errors(run)
        assert error["kf_ma"] < 1.05 * min(error.values()), (run, error)
        assert least < error["kf"] / error["kf_ma"] < most, (run, error)

    fitted = json.loads(folder.shell("gyrostat fit log.csv --columns 't=Time[ms],gyro=GyrZ[mdps]' --format json"))[0]
    noise = {row[0]: row[3] for row in fitted["rows"] if row[1] == "measurement_noise_std_dps"}
    assert f"white noise is {noise['likelihood']:.3f} dps, the robust moments' {noise['moments']:.3f} dps" in told, noise
print(f"{ran} blocks of the tutorial ran")
