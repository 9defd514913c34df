"""`gyrostat diagnose --simulated` on traces of a simulator that gyrostat does not contain.

    check_simulated.py PROGRAM FOLDER [CASES [SEED]]

The simulator is this one, of NumPy: white noise and a random walk. "Recordings" are its own with one effect of NumPy's
making, drawn with its strength by SEED (default: fixed) and kept from all but the last lines, which score. With CASES
the same is asked of so many, the labels being drawn anew: `check_simulated.py PROGRAM FOLDER 20 $RANDOM`.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

import numpy

program, folder = sys.argv[1], Path(sys.argv[2])
cases = int(sys.argv[3]) if len(sys.argv) > 3 else 3
seed = int(sys.argv[4]) if len(sys.argv) > 4 else 20261122
folder.mkdir(parents=True, exist_ok=True)
RATE, SAMPLES = 50.0, 20000
t = numpy.arange(SAMPLES) / RATE


def simulated(random):
    return 0.3 + 0.05 * random.standard_normal(SAMPLES) + numpy.cumsum(1e-4 * random.standard_normal(SAMPLES))


def narrow_band(random, hz, width):
    """Two leaky integrators turned to a frequency, of unit variance."""
    a = math.exp(-math.pi * width / RATE)
    drive = math.sqrt(1 - a * a) * (random.standard_normal(SAMPLES) + 1j * random.standard_normal(SAMPLES))
    state, out = random.standard_normal() + 1j * random.standard_normal(), numpy.empty(SAMPLES)
    turn = a * numpy.exp(2j * math.pi * hz / RATE)
    for k in range(SAMPLES):
        state = turn * state + drive[k]
        out[k] = state.real
    return out


def with_vibration(rate, random):
    return rate + random.uniform(0.03, 0.1) * narrow_band(random, random.uniform(4, 18), random.uniform(0.5, 2)), {"vibration"}


def with_grid(rate, random):
    step = random.uniform(0.02, 0.05)
    return step * numpy.round(rate / step), {"quantization"}


def with_markov(rate, random):
    tau = random.uniform(2, 8)
    a = math.exp(-1 / (RATE * tau))
    bias, x = numpy.empty(SAMPLES), 0.0
    for k, w in enumerate(math.sqrt(1 - a * a) * random.standard_normal(SAMPLES)):
        x = a * x + w
        bias[k] = x
    # Of a band of slow memories, names of the same band are right, too.
    return rate + random.uniform(0.015, 0.04) * bias, {"gauss_markov", "bias_instability"}


def with_outliers(rate, random):
    hit = random.uniform(size=SAMPLES) < random.uniform(0.005, 0.02)
    return rate + hit * random.uniform(0.3, 0.6) * random.standard_normal(SAMPLES), {"outliers"}


def as_it_is(rate, _):
    return rate, {"none"}


EFFECTS = [with_vibration, with_grid, with_markov, with_outliers]


def write(name, rate):
    numpy.savetxt(folder / name, numpy.column_stack([t, rate]), delimiter=",", header="t_s,gyro_dps", comments="",
                  fmt=["%.4f", "%.9g"])


def compared(recording, *traces, more=()):
    ended = subprocess.run([program, "diagnose", recording, "--simulated", *traces, "--json", "out.json", *more],
                           cwd=folder, capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads((folder / "out.json").read_text())


random = numpy.random.default_rng(seed)
write("sim_1.csv", simulated(random))
write("sim_2.csv", simulated(random))
right, wrong, closed, sealed = 0, [], [], []
for case in range(cases):
    # The last is none; whoever reads this does not know the others.
    effect = as_it_is if case == cases - 1 else EFFECTS[random.integers(len(EFFECTS))]
    rate, label = effect(simulated(random), random)
    write(f"rec_{case}.csv", rate)
    sealed.append(label)
answers = [compared(f"rec_{case}.csv", "sim_1.csv", "sim_2.csv", more=("--out-simulated", "mended", "--html", "page.html"))
           for case in range(cases)]
for answer, label in zip(answers, sealed):
    if answer["verdict"] in label:
        right += 1
    else:
        wrong.append((sorted(label), answer["verdict"], answer["gap"]["p_before"]))
    if "none" not in label:
        closed.append(answer["gap"]["closed"])
print(f"{right} of {cases} right; wrong: {wrong}; closed {[round(c, 2) for c in closed]}")
if cases <= 3:
    assert right == cases, wrong
    assert min(closed) > 0.5, closed
    # The traces with it added are of as many samples, and are no longer told that they lack it.
    mended = numpy.loadtxt(folder / "mended" / "sim_1.csv", delimiter=",", skiprows=1)
    assert mended.shape == (SAMPLES, 2)
    again = compared("rec_0.csv", "mended/sim_1.csv", "mended/sim_2.csv")
    assert not [e for e in again["effects"] if e["simulator"] == "lacks"], again["effects"]
    page = (folder / "page.html").read_text()
    assert "Where it agreed all along" in page and "sim_1.csv and 1 more against rec_" in page
    # What cannot be compared is refused with the reason.
    numpy.savetxt(folder / "fast.csv", numpy.column_stack([t / 2, rate]), delimiter=",", header="t_s,gyro_dps", comments="")
    for words, problem in ((("--simulated", "fast.csv"), "sampled at 100"), (("--simulated", "none.csv"), "none.csv"),
                           (("--simulated", "sim_1.csv", "--scenario", "x.json"), "--scenario"),
                           (("--simulated", "sim_1.csv", "--fail-if", "gap>1"), "--fail-if"),
                           (("--out-simulated", "x"), "--simulated")):
        ended = subprocess.run([program, "diagnose", "rec_0.csv", *words], cwd=folder, capture_output=True, text=True)
        assert ended.returncode == 2 and problem in ended.stderr, ended
    assert not (folder / "x.json").exists() and not (folder / "x").exists()
print("ok")
