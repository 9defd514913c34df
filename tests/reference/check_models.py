"""Files of `gyrostat export-model` parse in their own schema and give back N, B and K; inflations hold.

    check_models.py PROGRAM FOLDER

Independent of the program: units are converted here, Allan variances are of simulated signals.
"""
import ast
import json
import math
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
import yaml

program, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
DEG = math.pi / 180
RATE, WHITE, WALK, B = 100.0, 0.05, 1e-4, 2e-4  # Hz, dps a sample, dps a step, dps
N = WHITE * DEG / math.sqrt(RATE)
K = WALK * DEG * math.sqrt(RATE)


def said(*words):
    ended = subprocess.run([program, *words], cwd=folder, capture_output=True, text=True)
    assert ended.returncode == 0, (words, ended.stderr)
    return ended.stdout


def close(value, expected, what, relative=1e-6):
    assert abs(float(value) - expected) <= relative * abs(expected), f"{what}: {value}, expected {expected}"


def scenario(effects, duration_s=100):
    return {"duration_s": duration_s, "rate_hz": RATE, "effects": effects,
            "random_error": {"phi": 0, "delta1_dps": WALK, "delta2_dps": 0, "measurement_noise_std_dps": WHITE},
            "thermal_drift": {"a_dps_per_C": 0.001, "b_dps_s_per_C": 0, "c_dps": 0.02}}


def study(effects, **more):
    return {"cells": [{"name": "one", "trials": 1, "scenario": scenario(effects, **more), "filters": ["none"]}]}


VIBRATION = {"effect": "vibration", "std_dps": 0.1, "centre_hz": 5, "bandwidth_hz": 0.5}
FLICKER = {"effect": "bias_instability", "coefficient_dps": B}
GRID = {"effect": "quantization", "lsb_dps": 0.01}
MARKOV = {"effect": "gauss_markov", "std_dps": 0.03, "correlation_time_s": 40}

# As `diagnose --json` writes it, of which the program reads these keys.
diagnosis = {"verdict": "vibration", "gap": {"before": 4.0, "after": 0.2},
             "effects": [{"effect": "vibration", "gap_without": 3.5}, {"effect": "bias_instability", "gap_without": 0.6},
                         {"effect": "quantization", "gap_without": 0.4}],
             "steps": [{"added": "", "gap": 4.0}, {"added": "vibration", "gap": 1.0},
                       {"added": "bias_instability", "gap": 0.5}, {"added": "quantization", "gap": 0.2}],
             "enriched": scenario([VIBRATION, FLICKER, GRID])}
(folder / "gap.json").write_text(json.dumps(diagnosis))
(folder / "markov.json").write_text(json.dumps(study([MARKOV])))

# Kalibr: its keys are numbers, and nothing else is there.
text = said("export-model", "gap.json", "--for", "kalibr")
kalibr = yaml.safe_load(text)
assert set(kalibr) == {"rostopic", "update_rate", "gyroscope_noise_density", "gyroscope_random_walk"}, kalibr
assert all(isinstance(kalibr[key], float) for key in kalibr if key != "rostopic"), kalibr
close(kalibr["update_rate"], RATE, "kalibr rate")
close(kalibr["gyroscope_noise_density"], N, "kalibr N")
close(kalibr["gyroscope_random_walk"], K, "kalibr K")
words = " ".join(line.lstrip("# ") for line in text.splitlines() if line.startswith("#"))
close(re.search(r"B = (\S+) deg/h", words)[1], B * 3600, "B in the comment", 1e-3)
for effect in ("vibration", "bias_instability", "quantization"):
    assert re.search(rf"cannot hold.*{effect} \(", words), words
assert "leaves 100 % of the gap open" in words, words

# Gazebo: well-formed, the elements that SDFormat 1.9 has for noise, in each axis alike.
noise_elements = {"mean", "stddev", "bias_mean", "bias_stddev", "dynamic_bias_stddev",
                  "dynamic_bias_correlation_time", "precision"}
text = said("export-model", "gap.json", "--for", "gazebo")
root = ElementTree.fromstring(text)
sensor = root.find("./model/link/sensor[@type='imu']")
rate = float(sensor.find("update_rate").text)
for axis in "xyz":
    noise = sensor.find(f"./imu/angular_velocity/{axis}/noise")
    assert noise.get("type") == "gaussian_quantized" and {e.tag for e in noise} <= noise_elements
    value = {e.tag: float(e.text) for e in noise}
    close(value["stddev"] / math.sqrt(rate), N, "gazebo N")
    close(value["dynamic_bias_stddev"], K, "gazebo K")
    assert value["dynamic_bias_correlation_time"] > 1e6
    close(value["precision"], 0.01 * DEG, "gazebo grid")
assert "quantization (" not in text
assert "leaves at least 88 % of the gap open" in " ".join(text.split()), text  # 3.5 of 4 without vibration
value = {e.tag: float(e.text) for e in ElementTree.fromstring(
    said("export-model", "markov.json", "--for", "gazebo")).iter("noise").__next__()}
close(value["dynamic_bias_stddev"] * math.sqrt(value["dynamic_bias_correlation_time"] / 2), 0.03 * DEG, "gazebo bias")

# MATLAB: comments, `params = gyroparams;`, assignments of numbers to properties that gyroparams has, imuSensor.
properties = {"MeasurementRange", "Resolution", "ConstantBias", "AxesMisalignment", "NoiseDensity", "BiasInstability",
              "RandomWalk", "TemperatureBias", "TemperatureScaleFactor", "AccelerationBias", "NoiseType"}
number = r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?"
lines = said("export-model", "gap.json", "--for", "matlab").splitlines()
lines = [line for line in lines if not line.startswith("%")]
assert lines[0] == "params = gyroparams;"
matlab = {}
for line in lines[1:-1]:
    found = re.fullmatch(rf"params\.(\w+) = ({number}); % \S+", line)
    assert found and found[1] in properties, line
    matlab[found[1]] = float(found[2])
assert re.fullmatch(rf"imu = imuSensor\('accel-gyro', 'SampleRate', {number}, 'Gyroscope', params\);", lines[-1])
close(matlab["NoiseDensity"], N, "matlab N")
close(matlab["BiasInstability"], B * DEG, "matlab B")
close(matlab["RandomWalk"], K, "matlab K")
close(matlab["ConstantBias"], (0.02 + 25 * 0.001) * DEG, "matlab bias at 25 degC")
close(matlab["TemperatureBias"], 0.001 * DEG, "matlab bias per degC")

# The others.
ros = yaml.safe_load(said("export-model", "gap.json", "--for", "ros"))["/**"]["ros__parameters"]
assert len(ros["angular_velocity_covariance"]) == 9
close(ros["angular_velocity_covariance"][8], N * N * RATE, "ros covariance")
close(ros["gain"], math.sqrt(0.75) * N * math.sqrt(RATE), "ros gain")
python = ast.parse(said("export-model", "gap.json", "--for", "gnss_ins_sim"))
space = {}
exec(compile(python, "imu_err.py", "exec"), space)
err = space["imu_err"]
close(err["gyro_arw"][0], N / DEG * 60, "gnss-ins-sim N")
close(err["gyro_b_stability"][2] / 3600 * DEG * math.sqrt(2 / err["gyro_b_corr"][2]), K, "gnss-ins-sim K")
ast.parse(said("export-model", "gap.json", "--for", "isaac_lab"))
airsim = json.loads(said("export-model", "gap.json", "--for", "airsim"))
imu = airsim["DefaultSensors"]["Imu"]
close(imu["AngularRandomWalk"], N / DEG * 60, "airsim N")
close(imu["GyroBiasStability"] / 3600 * DEG / math.sqrt(imu["GyroBiasStabilityTau"]), K, "airsim K")
assert airsim["_comment"]
gyro = json.loads(said("export-model", "gap.json", "--for", "project_airsim"))["sensors"][0]["gyroscope"]
close(gyro["angle-random-walk"], N, "project airsim N")
px4 = dict(line.split("\t")[2:4] for line in said("export-model", "gap.json", "--for", "px4").splitlines()
           if not line.startswith("#"))
close(px4["EKF2_GYR_NOISE"], N * 10, "px4 N")
close(px4["EKF2_GYR_B_NOISE"], K * 10, "px4 K")
ardupilot = dict(line.split(",") for line in said("export-model", "gap.json", "--for", "ardupilot").splitlines()
                 if not line.startswith("#"))
close(ardupilot["EK3_GYRO_P_NSE"], N / math.sqrt(0.012), "ardupilot N", 1e-5)
ieee = json.loads(said("export-model", "gap.json", "--for", "ieee"))
for key, expected in (("N", N), ("B", B * DEG), ("K", K)):
    close(ieee[key]["value"], expected, key)
assert [e["effect"] for e in ieee["effects"]] == ["vibration", "bias_instability", "quantization"]
assert "leaves 5 % of the gap open, as the diagnosis does" in " ".join(ieee["_comment"]), ieee["_comment"]

# An inflation is what the Allan deviation of a simulated signal calls for.
(folder / "vibrating.json").write_text(json.dumps(study([VIBRATION], duration_s=2000)))
said("simulate", "vibrating.json", "--out", "vibrating.csv")
gyro = numpy.loadtxt(folder / "vibrating.csv", delimiter=",", skiprows=1, usecols=1)
total = numpy.concatenate([[0.0], numpy.cumsum(gyro - gyro.mean())])


def allan_variance(m):
    return numpy.mean((total[2 * m:] - 2 * total[m:-m] + total[:-2 * m]) ** 2) / (2 * m * m)


AVERAGING = 1.0
white = WHITE / math.sqrt(RATE)
needed = max(math.sqrt(m / RATE * (allan_variance(m) - (WALK * math.sqrt(RATE)) ** 2 * m / RATE / 3)) / white
             for m in range(1, int(AVERAGING * RATE) + 1))
kalibr = yaml.safe_load(said("export-model", "vibrating.json", "--for", "kalibr", "--inflate",
                             "--averaging", str(AVERAGING)))
close(kalibr["gyroscope_noise_density"] / N, needed, "inflation of N", 0.05)
text = " ".join(said("export-model", "vibrating.json", "--for", "kalibr").split())
stated = re.search(r"Inflate N by (\S+) up to (\S+) s, because of vibration", text)
close(stated[1], needed, "inflation as stated", 0.08)

# From the recording itself: N within its interval, and the same inflation by what was measured.
ieee = json.loads(said("export-model", "vibrating.csv", "--for", "ieee"))
assert ieee["N"]["from"] < ieee["N"]["value"] < ieee["N"]["to"]
said("export-model", "vibrating.json", "--for", "all", "--out", "all")
assert len(list((folder / "all").iterdir())) == 11
for words, problem in ((("gap.json", "--for", "kalib"), "kalibr"), (("vibrating.csv", "--for", "px4", "--cell", "x"), "--cell"),
                       (("gap.json", "--for", "all"), "--out")):
    ended = subprocess.run([program, "export-model", *words], cwd=folder, capture_output=True, text=True)
    assert ended.returncode == 2 and problem in ended.stderr and ended.stderr.count("\n") == 1, ended
print("ok")
