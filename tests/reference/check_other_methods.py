"""The other methods' laws are those of what they simulate, and they answer an exported blind check.

    check_other_methods.py PROGRAM FOLDER
"""
import json
import pathlib
import shutil
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(root / "examples/other_methods"))
try:
    import numpy as np
    import scipy  # noqa: F401
except ImportError as missing:
    print(f"SKIPPED: {missing}")
    sys.exit()

import answer
import gmwm
from recording import wavelet_variance

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])

# Each process alone: its mean wavelet variances over simulated series are its law's.
random = np.random.default_rng(1)
for process, values in ((gmwm.quantization, [2.0]), (gmwm.white, [0.5]), (gmwm.walk, [0.1]),
                        (gmwm.first_order, [0.7, 12.0])):
    model = gmwm.Model([process], values)
    model.logs = model.starts
    seen = np.mean([wavelet_variance(gmwm.replica(model, 4096, random)) for _ in range(200)], axis=0)
    size = 2.0 ** np.arange(len(seen))
    worst = np.max(np.abs(seen / model.variance(size, model.logs) - 1))
    assert worst < 0.15, f"{process.__name__}: {worst:.3f} off its law"
count = np.arange(4096)
for process, values, signal in ((gmwm.sine, [0.3, 37.0], 0.3 * np.sin(2 * np.pi * count / 37.0)),
                                (gmwm.ramp, [0.02], 0.02 * count)):
    size = 2.0 ** np.arange(4)
    worst = np.max(np.abs(wavelet_variance(signal)[:4] / process(size, *values) - 1))
    assert worst < 0.02, f"{process.__name__}: {worst:.3f} off its law"

# A few recordings, most of them without an effect and one strong effect each that the method can see.
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
still = {"duration_s": 200, "rate_hz": 20,
         "random_error": {"delta1_dps": 0.0002, "delta2_dps": 0.0002, "measurement_noise_std_dps": 0.05}}
check = {"recordings": 2, "none_recordings": 4, "scenarios": {"still": still},
         "cases": [{"effect": "angle_quantization", "scenario": "still", "strong": {"coefficient_deg": 0.01}}]}
(folder / "check.json").write_text(json.dumps(check))
said = subprocess.run([program, "blind-check", "check.json", "--export", "out", "--seed", "3"], cwd=folder,
                      check=True, capture_output=True, text=True).stdout
key = said.split()[1]
for method in answer.METHODS:
    answer.main(method, folder / "out", folder / method)
    tables = json.loads(subprocess.run(
        [program, "blind-check", "out", "--score", method, "--key", key, "--format", "json"],
        cwd=folder, check=True, capture_output=True, text=True).stdout)
    print(method, json.dumps(tables)[:600])
    verdicts = [json.loads(path.read_text())["verdict"] for path in sorted((folder / method).glob("*.json"))]
    assert len(verdicts) == 6, verdicts
    seen = "angle_quantization" if method == "gmwm" else "unknown"
    assert verdicts.count(seen) in (2, 3), f"{method}: {verdicts}"
