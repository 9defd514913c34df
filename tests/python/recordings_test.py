"""Recordings in and out of Python, and what is asked of them."""
import json
import sys
import threading
import time
import unittest

from common import InAFolder, SMALL, program, small

import numpy as np

import gyrostat


def bits(array):
    return np.ascontiguousarray(array).tobytes()


class Recordings(InAFolder):
    def setUp(self):
        super().setUp()
        self.made = gyrostat.simulate(small(duration_s=40, temperature={"profile": "cycle"}), trial=3)

    def test_a_simulated_trial_is_that_of_the_program(self):
        with open("small.json", "w") as file:
            json.dump(small(duration_s=40, temperature={"profile": "cycle"}), file)
        program("simulate", "small.json", "--trial", 3, "--out", "theirs.csv")
        self.made.write("ours.csv")
        with open("ours.csv") as ours, open("theirs.csv") as theirs:
            self.assertEqual(ours.read(), theirs.read())

    def test_files_arrays_and_frames_are_the_same_recording(self):
        self.made.write("rec.csv")
        ways = [gyrostat.read("rec.csv"), gyrostat.recording(self.made.channels)]
        try:
            import pandas
            ways.append(gyrostat.recording(self.made.frame))
            self.assertIs(type(self.made.frame), pandas.DataFrame)
        except ImportError:
            pass
        for way in ways:
            self.assertEqual(list(way.channels), list(self.made.channels))
            for name, values in way.channels.items():
                self.assertEqual(bits(values), bits(self.made[name]), name)

    def test_columns_and_units_are_those_of_files(self):
        radians = gyrostat.recording({"Time": self.made["t_s"] * 1e3, "GyrZ": np.radians(self.made["gyro_dps"])},
                                     columns={"t": "Time[ms]", "gyro": "GyrZ"}, units={"gyro": "rad/s"})
        np.testing.assert_allclose(radians["gyro_dps"], self.made["gyro_dps"], rtol=1e-14)
        np.testing.assert_allclose(radians["t_s"], self.made["t_s"], atol=1e-12)
        alone = gyrostat.recording(self.made["gyro_dps"], rate_hz=20)
        self.assertEqual(bits(alone["gyro_dps"]), bits(self.made["gyro_dps"]))

    def test_channels_look_at_the_recordings_memory_and_outlive_it(self):
        rate = self.made["gyro_dps"]
        self.assertTrue(np.shares_memory(rate, self.made["gyro_dps"]))
        self.assertFalse(rate.flags.writeable)
        before = rate.copy()
        del self.made
        self.assertEqual(bits(rate), bits(before))

    def test_an_array_is_read_where_it_lies(self):
        rate = np.array(self.made["gyro_dps"])
        ours = gyrostat.allan(rate, rate_hz=20)
        theirs = gyrostat.allan(self.made)
        np.testing.assert_allclose(ours[0]["deviation"], theirs[0]["deviation"], rtol=1e-9)
        self.assertEqual(ours[0].units["deviation"], "dps")
        self.assertIn("<img", ours._repr_html_())
        self.assertIn("<svg", ours.pictures[0].svg)

    def test_tables_are_those_of_the_program(self):
        self.made.write("rec.csv")
        for verb, ours in (("allan", gyrostat.allan("rec.csv")), ("fit", gyrostat.fit("rec.csv")),
                           ("apply", gyrostat.apply("rec.csv"))):
            printed, _ = program(verb, "rec.csv")
            for table in ours:
                self.assertIn(repr(table).strip(), printed, verb)
        self.assertGreaterEqual(set(gyrostat.fit("rec.csv").parameters), {"phi", "delta1_dps"})

    def test_applied_series_are_those_of_the_program(self):
        self.made.write("rec.csv")
        filters = [{"id": "mine", "filter": "kf", "parameters": {"phi": 0.3}}]
        with open("config.json", "w") as file:
            json.dump({"filters": filters}, file)
        program("apply", "rec.csv", "--config", "config.json", "--out", "out.csv")
        theirs = np.genfromtxt("out.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
        series = gyrostat.apply("rec.csv", filters, calibration=0).series
        self.assertEqual(tuple(series), theirs.dtype.names)
        self.assertEqual(bits(series["mine_estimate_dps"]), bits(theirs["mine_estimate_dps"]))

    def test_what_cannot_be_done_is_one_exception_with_the_programs_line(self):
        self.made.write("rec.csv")
        for arguments, call in (
                (("allan", "none.csv"), lambda: gyrostat.allan("none.csv")),
                (("allan", "rec.csv", "--axis", "z"), lambda: gyrostat.read("rec.csv", "z"))):
            _, complaint = program(*arguments, expected=2)
            with self.assertRaises(gyrostat.Error) as raised:
                call()
            self.assertIn(str(raised.exception), complaint)
        with self.assertRaisesRegex(gyrostat.Error, "^the recording.*gyro_dps"):
            gyrostat.recording({"t_s": [0.0, 1.0], "gyroo_dps": [1.0, 2.0]})
        with self.assertRaisesRegex(gyrostat.Error, "dimensions"):
            gyrostat.allan(np.zeros((4, 4)), rate_hz=1)
        with self.assertRaises(TypeError):
            gyrostat.recording(5)

    def test_other_threads_of_python_go_on_meanwhile(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.001)

        long = gyrostat.simulate(small(duration_s=400), trial=0)
        sys.setswitchinterval(10)  # a lock that is not released is not lost either
        thread = threading.Thread(target=count)
        thread.start()
        before, start = counted[0], time.monotonic()
        gyrostat.fit(long)
        share = (counted[0] - before) * 0.001 / (time.monotonic() - start)
        done.set()
        thread.join()
        sys.setswitchinterval(0.005)
        self.assertGreater(share, 0.05)

    def test_a_diagnosis_answers_and_tells_how_far_it_is(self):
        coarse = gyrostat.simulate(small(duration_s=60, effects=[{"effect": "quantization", "lsb_dps": 0.05}]))
        heard = []
        found = gyrostat.diagnose(coarse, progress=lambda what, share: heard.append(share))
        self.assertTrue(found.answer)
        self.assertIn(found.answer[:40], repr(found))
        self.assertEqual(found.json["verdict"] is not None, True)
        self.assertTrue(heard and heard == sorted(heard), heard)
        self.assertGreater(len(found.pictures), 2)
        self.assertEqual(found.study["cells"][0]["scenario"]["rate_hz"], 20)
        found.write("gap.html")
        with open("gap.html", encoding="utf-8") as page:
            self.assertIn("</html>", page.read())

    def test_what_is_not_the_sensors_is_left_out_as_the_program_does(self):
        t_s = np.arange(8000) / 50
        rate = lambda at: 40 * np.sin(0.9 * at) + 25 * np.sin(2.3 * at + 1)
        noise = np.random.default_rng(20550).normal(size=(2, t_s.size))
        late = gyrostat.recording({"t_s": t_s, "gyro_dps": rate(t_s - 0.1) + 0.05 * noise[0],
                                   "rate_ref_dps": rate(t_s)})
        found = gyrostat.diagnose(late)
        self.assertTrue(any("5 samples later than the reference" in note for note in found.notes))
        self.assertEqual([effect["effect"] for effect in found.json["effects"]], ["time_offset"])

    def test_a_recording_too_long_for_one_diagnosis_is_refused_with_the_remedy(self):
        long = gyrostat.recording(np.arange(2 ** 22 + 1) % 7 * 0.01, rate_hz=1000)
        with self.assertRaisesRegex(gyrostat.Error, r"4194305 samples; allowed: up to 4194304, as between\(\)"):
            gyrostat.diagnose(long)


if __name__ == "__main__":
    unittest.main()
