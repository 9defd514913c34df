"""Filters and effects written in Python."""
import os
import signal
import subprocess
import sys
import time
import unittest

from common import InAFolder, small
from studies_test import exported

import numpy as np

import gyrostat


@gyrostat.filter
def exponential(samples, *, gain: gyrostat.Parameter("1", 0, 1) = 0.01):
    """a running mean that forgets"""
    estimate = 0.0
    for sample in samples:
        if sample.gyro_dps == sample.gyro_dps:
            estimate += gain * (sample.gyro_dps - estimate)
        yield estimate


@gyrostat.filter
def scalar_kalman(samples, *, delta1_dps=2e-5, measurement_noise_std_dps=0.02):
    """a random walk in white noise, told the calibration's numbers"""
    estimate, variance = 0.0, 1.0
    for sample in samples:
        variance += delta1_dps**2
        s = variance + measurement_noise_std_dps**2
        innovation = sample.gyro_dps - estimate
        estimate += variance / s * innovation
        variance *= measurement_noise_std_dps**2 / s
        yield estimate, variance, innovation, s


@gyrostat.filter
def nothing(t_s, gyro_dps, temperature_C, heading_deg):
    """what doing nothing is, at once"""
    return np.zeros_like(t_s)


@gyrostat.effect(stage="conversion")
def clipped(signal, noise, *, limit_dps: gyrostat.Parameter("dps", 0, 1e9) = 50):
    """the output is clipped"""
    return np.clip(signal["gyro_dps"], -limit_dps, limit_dps)


@gyrostat.effect
def popcorn(signal, noise, *, amplitude_dps=0.02):
    """a level that jumps"""
    return signal["gyro_dps"] + amplitude_dps * (np.cumsum(noise("jumps") > 2.5) % 2)


def values(run, method, metric="bias_rmse"):
    outcomes = run.outcomes()
    return outcomes[metric][outcomes["method"] == method]


def run(study, folder, **how):
    return gyrostat.run(study, folder, progress=False, **how)


class Filters(InAFolder):
    def test_any_number_of_threads_and_any_repetition_give_the_same_bytes(self):
        study = small("none", "kf", "exponential", {"id": "slow", "filter": "exponential", "parameters": {"gain": 0.001}},
                      "scalar_kalman", trials=9, effects=[{"effect": "popcorn"}])
        runs = [run(study, f"run_{threads}_{i}", threads=threads) for i, threads in enumerate((1, 5, 1))]
        for other in runs[1:]:
            self.assertEqual(exported(other.folder), exported(runs[0].folder))
        ranked = gyrostat.rank(runs[0])[0]
        self.assertEqual(set(ranked["method"]), {"none", "kf", "exponential", "slow", "scalar_kalman"})
        self.assertTrue(np.all(values(runs[0], "exponential") != values(runs[0], "slow")))
        self.assertTrue(np.all(np.isfinite(values(runs[0], "scalar_kalman", "nis"))))
        self.assertEqual(runs[0].failed, 0)

    def test_a_filter_that_does_nothing_is_none_to_the_bit(self):
        made = run(small("none", "nothing"), "run")
        for metric in ("bias_rmse", "rate_rmse", "heading_end"):
            self.assertEqual(values(made, "nothing", metric).tobytes(), values(made, "none", metric).tobytes())

    def test_it_is_told_the_calibration_under_gyrostats_names(self):
        told = []

        @gyrostat.filter
        def listening(t_s, gyro_dps, temperature_C, heading_deg, *, measurement_noise_std_dps=123.0):
            told.append(measurement_noise_std_dps)
            return np.zeros_like(t_s)

        run(small("kf", "listening", trials=1), "run")
        self.assertNotIn(123.0, told)
        run(small({"filter": "listening", "parameters_from": "defaults"}, trials=1), "defaults")
        self.assertEqual(told[-1], 123.0)

    def test_it_is_applied_to_a_recording(self):
        recording = gyrostat.simulate(small())
        series = gyrostat.apply(recording, ["none", {"filter": "exponential", "parameters": {"gain": 0.5}}],
                                calibration=0).series
        estimate, mine = 0.0, []
        for rate in recording["gyro_dps"]:
            estimate += 0.5 * (rate - estimate)
            mine.append(estimate)
        self.assertEqual(series["exponential_estimate_dps"].tobytes(), np.array(mine).tobytes())

    def test_what_it_raises_is_counted_in_its_own_trial(self):
        @gyrostat.filter
        def fragile(t_s, gyro_dps, temperature_C, heading_deg):
            """raises where the first sample is below 0"""
            if gyro_dps[0] < 0:
                raise ValueError("too low")
            return np.zeros_like(t_s)

        study = small("none", "kf", "fragile", trials=20)
        made = [run(study, f"run_{threads}", threads=threads) for threads in (1, 4)]
        self.assertEqual(exported("run_1"), exported("run_4"))
        self.assertEqual(made[0].failures, made[1].failures)
        below = [trial for trial in range(20) if gyrostat.simulate(study, trial)["gyro_dps"][0] < 0]
        self.assertTrue(0 < len(below) < 20, below)
        self.assertEqual([(trial, method) for _, trial, method, _ in made[0].failures],
                         [(trial, "fragile") for trial in below])
        self.assertRegex(made[0].failures[0][3], r"^threw: ValueError: too low \(fragile, line \d+\)$")
        without = run(small("none", "kf", trials=20), "without")
        for method in ("none", "kf"):
            self.assertEqual(values(made[0], method).tobytes(), values(without, method).tobytes())

    def test_it_cannot_look_ahead_nor_leave_samples_out(self):
        @gyrostat.filter
        def ahead(samples):
            for sample, after in zip(samples, samples):
                yield after.gyro_dps
                yield after.gyro_dps

        @gyrostat.filter
        def lazy(samples):
            yield next(samples).gyro_dps

        @gyrostat.filter
        def short(t_s, *channels):
            return t_s[1:]

        why = {method: why for _, _, method, why in run(small("ahead", "lazy", "short", trials=1), "run").failures}
        self.assertIn("looks at sample 2 before it has answered sample 1", why["ahead"])
        self.assertIn("1 answers came back for 200 samples", why["lazy"])
        self.assertIn("199 numbers came back for 200 samples", why["short"])

    def test_no_number_leaves_it(self):
        @gyrostat.filter
        def blank(samples):
            for sample in samples:
                yield 0.5 if sample.t_s < 1 else float("nan")

        applied = gyrostat.apply(gyrostat.simulate(small()), ["blank"], calibration=0)
        self.assertTrue(np.all(applied.series["blank_estimate_dps"] == 0.5))
        self.assertEqual(applied.series["blank_status"].count("not_finite"), 180)

    def test_parameters_have_ranges_and_names(self):
        for parameters, complaint in (({"gain": 2}, r"gain.*\[0, 1\]"), ({"gainn": 0.1}, "gain")):
            with self.assertRaisesRegex(gyrostat.Error, complaint):
                run(small({"filter": "exponential", "parameters": parameters}), "run")
        with self.assertRaisesRegex(gyrostat.Error, "gain.*out of range"):
            @gyrostat.filter
            def wrong(samples, *, gain: gyrostat.Parameter("1", 0, 1) = 2):
                yield 0
        with self.assertRaisesRegex(gyrostat.Error, "there is a filter of this name"):
            gyrostat.filter(nothing, name="kf")
        with self.assertRaisesRegex(gyrostat.Error, "heading_deg"):
            gyrostat.filter(nothing, name="needy", needs=["rate_ref_dps"])

    def test_outcomes_of_other_code_under_the_same_name_are_refused(self):
        def changing(t_s, *channels):
            return np.zeros_like(t_s)

        first = gyrostat.filter(changing, name="changing")
        run(small("changing", trials=1), "run")
        run(small("changing", trials=2), "run")  # the same code goes on

        def changed(t_s, *channels):
            return np.ones_like(t_s)

        gyrostat.filter(changed, name="changing")
        with self.assertRaisesRegex(gyrostat.Error, "outcomes of build .* with changing"):
            run(small("changing", trials=3), "run")
        gyrostat.filter(first, name="changing")
        self.assertEqual(len(run(small("changing", trials=3), "run").outcomes()["trial"]), 3)

    def test_ctrl_c_ends_one_that_hangs_and_that_is_no_outcome(self):
        with open("hanging.py", "w") as file:
            file.write(f"""
import os, gyrostat
@gyrostat.filter
def hanging(t_s, gyro_dps, temperature_C, heading_deg):
    if os.path.exists("hang") and gyro_dps[0] < 0:
        print("hanging", flush=True)
        while True:
            pass
    return 0 * t_s
print(len(gyrostat.run({small("none", "hanging", trials=20)!r}, "run", progress=False).failures))
""")
        open("hang", "w").close()
        child = subprocess.Popen([sys.executable, "hanging.py"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(child.kill)
        self.assertIn("hanging", child.stdout.readline())  # in more than one thread at once
        child.send_signal(signal.SIGINT)
        _, complaint = child.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", complaint)
        os.remove("hang")
        done = subprocess.run([sys.executable, "hanging.py"], capture_output=True, text=True)
        self.assertEqual((done.stdout, done.returncode), ("0\n", 0), done.stderr)


class Effects(InAFolder):
    def test_one_in_python_is_ours_to_the_bit(self):
        ours = small("none", "kf", effects=[{"effect": "saturation", "limit_dps": 0.01}])
        mine = small("none", "kf", effects=[{"effect": "clipped", "limit_dps": 0.01}])
        for trial in range(3):
            self.assertEqual(gyrostat.simulate(mine, trial)["gyro_dps"].tobytes(),
                             gyrostat.simulate(ours, trial)["gyro_dps"].tobytes())
        self.assertEqual(exported(run(mine, "mine").folder), exported(run(ours, "ours").folder))

    def test_its_noise_moves_no_other_draw(self):
        plain, jumping = (gyrostat.simulate(small(duration_s=100, effects=effects), 2)
                          for effects in ([], [{"effect": "popcorn", "amplitude_dps": 0.5}]))
        levels = np.round(jumping["gyro_dps"] - plain["gyro_dps"], 12)
        self.assertEqual(set(levels), {0.0, 0.5})
        self.assertEqual(jumping["random_error_dps"].tobytes(), plain["random_error_dps"].tobytes())

    def test_what_it_raises_is_the_outcome_of_its_trial(self):
        @gyrostat.effect
        def broken(signal, noise):
            if signal["gyro_dps"][0] < 0:
                raise RuntimeError("broke")
            return signal["gyro_dps"]

        study = small("none", "kf", trials=12, effects=[{"effect": "broken"}])
        study["cells"][0]["parameters_from"] = "truth"
        made = run(study, "run")
        self.assertTrue(0 < made.failed < 12, made.failed)
        self.assertIn("RuntimeError: broke", made.failures[0][3])

    def test_the_environment_is_changed_before_the_gyro_meets_it(self):
        @gyrostat.effect(stage="environment")
        def sunshine(signal, noise, *, warming_C: gyrostat.Parameter("degC", -50, 50) = 5.0):
            return {"temperature_C": signal["temperature_C"] + warming_C}

        @gyrostat.effect(stage="environment")
        def nudge(signal, noise):
            return {"rate_ref_dps": signal["rate_ref_dps"] + 2.0}

        @gyrostat.effect(stage="environment")
        def wrong(signal, noise):
            return {"gyro_dps": signal["gyro_dps"]}

        study = small("none", thermal_drift={"a_dps_per_C": 0.01})
        scenario = study["cells"][0]["scenario"]
        plain = gyrostat.simulate(study)
        scenario["effects"] = [{"effect": "sunshine", "warming_C": 10}, {"effect": "nudge"}]
        changed = gyrostat.simulate(study)
        np.testing.assert_allclose(changed["temperature_C"], plain["temperature_C"] + 10, atol=1e-12)
        np.testing.assert_allclose(changed["rate_ref_dps"], plain["rate_ref_dps"] + 2, atol=1e-12)
        np.testing.assert_allclose(changed["gyro_dps"], plain["gyro_dps"] + 2 + 0.1, atol=1e-12)
        scenario["effects"] = [{"effect": "wrong"}]
        with self.assertRaisesRegex(Exception, "unknown channel of this stage 'gyro_dps'"):
            gyrostat.simulate(study)

    def test_stages_and_channels_are_known_by_name(self):
        with self.assertRaisesRegex(gyrostat.Error, "did you mean 'electronics'"):
            gyrostat.effect(clipped, stage="electronic", name="other")
        with self.assertRaisesRegex(gyrostat.Error, "did you mean 'temperature_C'"):
            gyrostat.effect(clipped, needs=["temperature"], name="other")


if __name__ == "__main__":
    unittest.main()
