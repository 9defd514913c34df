"""docs/tutorial.md from a clean folder: its commands in order, and what it shows of what they print.

    check_tutorial.py PROGRAM ROOT

A block of text below commands is theirs, to the letter; "…" stands for lines left out. What a machine's speed decides is
masked. Numbers of a diagnosis, and of studies of what it found, agree within two hundredths, probabilities by as much of 1:
its hundred replicas are counted beyond thresholds, and the C library's last bits, which differ from processor to processor,
move a count.
"""
import json
import re
import sys
from pathlib import Path

from blocks import Folder, blocks_of

OF_THE_MACHINE = [(r"predicted run time \S+ (s|min|h)", "predicted run time # s")]
NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]\d+)?")
WITHIN = {"enriched.json": 0.02}
PROBABILITY = re.compile(r"\bp [<=]")
SCREEN = 80


def masked(text):
    for pattern, instead in OF_THE_MACHINE:
        text = re.sub(pattern, instead, text)
    return text.splitlines()


def alike(shown, printed, within):
    """The same lines, but for numbers that differ by a share of themselves, or of 1 where a line has a probability."""
    return len(shown) == len(printed) and all(
        NUMBER.split(a) == NUMBER.split(b) and
        all(abs(float(x) - float(y)) <= within * (1.0 if PROBABILITY.search(a) else float(x))
            for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)))
        for a, b in zip(shown, printed))


def first_missing(shown, printed, within=0.0):
    """The first piece of what is shown that is not printed, line by line and in order; nothing where all are."""
    rest = masked(printed)
    pieces = re.split(r"^…\n", shown, flags=re.M)
    for k, piece in enumerate(pieces):
        lines = masked(piece)
        places = [at for at in range(len(rest) - len(lines) + 1) if alike(lines, rest[at:at + len(lines)], within)]
        if k == 0 and lines:
            places = [at for at in places if at == 0]
        if k + 1 == len(pieces) and lines:
            places = [at for at in places if at + len(lines) == len(rest)]
        if not places:
            return piece
        rest = rest[places[0] + len(lines):]
    return None


def require_comparison_bites():
    printed = "a 1\nb 2\nc 3\n"
    assert first_missing("a 1\n…\nc 3\n", printed) is None
    assert first_missing("…\nb 2\n…\n", printed) is None
    for wrong in ("a 1\n", "b 2\n…\n", "…\nb 2\n", "…\nb 3\n…\n", "…\nc 3\n…\na 1\n…\n", "a 1\nc 3\n"):
        assert first_missing(wrong, printed) is not None, wrong
    assert first_missing("gap 2.55 dps\n", "gap 2.56 dps\n") is not None
    assert first_missing("gap 2.55 dps\n", "gap 2.56 dps\n", 0.01) is None
    assert first_missing("as it is, = 0.97 with\n", "as it is, = 0.96 with\n", 0.01) is not None
    assert first_missing("p < 1e-6, = 0.97 with\n", "p < 1e-6, = 0.96 with\n", 0.02) is None
    for wrong in ("gap 2.55 dps\n", "gap 2.6 deg\n", "gap 2.6 2.6 dps\n"):
        assert first_missing(wrong, "gap 2.6 dps\n", 0.01) is not None, wrong


require_comparison_bites()
program, root = sys.argv[1:3]
page = Path(root) / "docs" / "tutorial.md"
with Folder(program) as folder:
    ran, compared, printed = 0, 0, ""
    for language, text in blocks_of(page, "sh", "text"):
        if language == "sh":
            printed = folder.shell(text)
            within = next((share for command, share in WITHIN.items() if command in text), 0.0)
            ran += 1
            continue
        assert max(map(len, text.splitlines())) <= SCREEN, "wider than a screen:\n" + text
        missing = first_missing(text, printed, within)
        if missing is not None:
            sys.exit(f"the tutorial shows\n{missing}\nand the commands print\n{printed}")
        compared += 1
    assert ran >= 7, ran
    assert compared >= 5, compared

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

    for run, least, most in (("around", 1.05, 1.2), ("with_likelihood", 1.8, 2.3), ("with_moments", 1.8, 2.3)):
        error = errors(run)
        assert error["kf_ma"] < 1.05 * min(error.values()), (run, error)
        assert least < error["kf"] / error["kf_ma"] < most, (run, error)

    fitted = json.loads(folder.shell("gyrostat fit log.csv --columns 't=Time[ms],gyro=GyrZ[mdps]' --format json"))[0]
    noise = {row[0]: row[3] for row in fitted["rows"] if row[1] == "measurement_noise_std_dps"}
    assert f"white noise is {noise['likelihood']:.3f} dps, the robust moments' {noise['moments']:.3f} dps" in told, noise
print(f"{ran} blocks of the tutorial ran, {compared} outputs are what they print")
