"""Studies from Python: the program's bytes, resumed, ranked, ended by Ctrl-C."""
import gzip
import json
import os
import signal
import subprocess
import sys
import time
import unittest

from common import InAFolder, program, small

import numpy as np

import gyrostat


def exported(folder):
    with gzip.open(os.path.join(folder, "outcomes.csv.gz")) as file:
        return file.read()


class Studies(InAFolder):
    def test_a_dict_a_file_and_the_program_give_the_same_bytes(self):
        with open("small.json", "w") as file:
            json.dump(small(), file)
        program("run", "small.json", "--out", "theirs")
        gyrostat.run("small.json", "of_a_file", progress=False)
        run = gyrostat.run(small(), "of_a_dict", name="small", threads=3, progress=False)
        self.assertEqual(exported("of_a_file"), exported("theirs"))
        self.assertEqual(exported("of_a_dict"), exported("theirs"))
        self.assertEqual(run.stopped, "")
        header, *rows = exported("theirs").decode().splitlines()
        outcomes = run.outcomes()
        self.assertEqual(list(outcomes), header.split(","))
        self.assertEqual(len(outcomes["trial"]), len(rows))
        column = header.split(",").index("bias_rmse")
        self.assertEqual([float(row.split(",")[column]) for row in rows], list(outcomes["bias_rmse"]))

    def test_a_run_goes_on_where_it_ended(self):
        gyrostat.run(small(), "whole", progress=False)
        gyrostat.run(small(), "parts", trials=2, progress=False)
        heard = []
        run = gyrostat.run(small(), "parts", progress=lambda what, share: heard.append((what, share)))
        self.assertEqual(exported("parts"), exported("whole"))
        self.assertEqual(run.study["cells"][0]["name"], "still")
        again = gyrostat.Run("parts")
        self.assertEqual(list(again.outcomes()["bias_rmse"]), list(run.outcomes()["bias_rmse"]))
        with self.assertRaisesRegex(gyrostat.Error, "holds outcomes of another study"):
            gyrostat.run(small(duration_s=11), "parts", progress=False)

    def test_rankings_pictures_and_the_report_are_shown(self):
        run = gyrostat.run(small(), "shown", progress=False)
        ranked = gyrostat.rank(run)
        self.assertIn(repr(ranked[0]).strip(), program("rank", "shown")[0])  # beneath the answer
        self.assertEqual(set(ranked[0]["method"]), {"none", "kf", "oracle"})
        self.assertIn("rate_rmse", gyrostat.rank("shown", cell="still", metric="rate_rmse")[0].title)
        html = run._repr_html_()
        self.assertGreater(html.count("<img"), 2)
        self.assertIn("<table", html)
        self.assertGreater(len(run.pictures_of(replay=2)), len(run.pictures))
        self.assertIn("</html>", run.report(replay=0).read_text())
        with self.assertRaisesRegex(gyrostat.Error, "did you mean 'still'"):
            gyrostat.rank(run, cell="stil")

    def test_sensitivities_are_the_programs(self):
        study = small("kf")
        study["cells"][0] |= {"trials": 2, "parameters_from": "truth", "design": {
            "kind": "morris", "trajectories": 2,
            "parameters": {"scenario.random_error.phi": {"from": 0.1, "to": 0.9}}}}
        run = gyrostat.run(study, "varied", progress=False)
        printed = program("sensitivity", "varied")[0]
        for table in gyrostat.sensitivity(run):
            self.assertIn(repr(table).strip(), printed)
        self.assertGreater(len(gyrostat.sensitivity(run, points=True)[0]), 2)

    def test_tuning_is_the_programs(self):
        study = small("none", "kf", "stf")
        with open("small.json", "w") as file:
            json.dump(study, file)
        asked = ["--method", "kf", "--range", "phi=0.1:0.9", "--budget", 400, "--fresh", 50, "--by", "cvar95"]
        printed = program("tune", "small.json", *asked, "--json", "theirs.json", "--out", "tuned.json")[0]
        heard = []
        tuned = gyrostat.tune(study, name="small", methods=["kf"], ranges={"phi": (0.1, 0.9)}, budget=400, fresh=50,
                              by="cvar95", threads=3, progress=lambda what, share: heard.append(share))
        with open("theirs.json") as theirs, open("tuned.json") as their_study:
            self.assertEqual(tuned.json, json.load(theirs))
            self.assertEqual(tuned.study, json.load(their_study))
        for table in tuned:
            self.assertIn(repr(table).strip(), printed)
        self.assertEqual(" ".join(tuned.answer.split()), " ".join(printed.split("\n\n")[0].split()))
        self.assertIn("<table", tuned._repr_html_())
        self.assertEqual(list(tuned[0]["method"]), ["kf"])
        gyrostat.run(tuned.study, "of_tuned", progress=False)
        for wrong, line in [({"methods": ["kff"]}, "method: unknown method 'kff'; did you mean 'kf'"),
                            ({"ranges": {"phii": (0, 1)}}, "range phii=0.0:1.0: unknown parameter 'phii'"),
                            ({"ranges": {"phi": (0, 2)}}, "range phi=0.0:2.0: 2 1 is out of range"),
                            ({"by": "median"}, "by: unknown measure 'median'"),
                            ({"above": -1}, "above: -1 is out of range"), ({"fresh": 3}, "fresh: 3 is out of range"),
                            ({"cell": "stil"}, "cell: unknown cell 'stil'; did you mean 'still'")]:
            with self.assertRaises(gyrostat.Error) as raised:
                gyrostat.tune(study, **wrong)
            self.assertIn(line, str(raised.exception))

    def test_all_mistakes_of_a_study_come_in_the_programs_words(self):
        wrong = small("kff", rate_hz=-5)
        with open("wrong.json", "w") as file:
            json.dump(wrong, file)
        _, complaint = program("run", "wrong.json", expected=2)
        with self.assertRaises(gyrostat.Error) as raised:
            gyrostat.run(wrong, name="wrong")
        for line in str(raised.exception).splitlines():
            self.assertIn(line, complaint)
        self.assertFalse(os.path.exists("runs"))

    def test_ctrl_c_ends_a_run_in_good_order(self):
        study = small(trials=100000)
        script = f"import gyrostat; gyrostat.run({study!r}, 'stopped', progress=lambda *now: print('on', flush=True))"
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(child.kill)
        child.stdout.readline()
        asked = time.monotonic()
        child.send_signal(signal.SIGINT)
        _, complaint = child.communicate(timeout=60)
        self.assertIn("KeyboardInterrupt", complaint)
        self.assertLess(time.monotonic() - asked, 20)  # a loaded machine; alone it takes 0.3 s
        finished = gyrostat.Run("stopped").outcomes()
        done = int(finished["trial"].max()) + 1
        self.assertGreater(done, 0)
        fewer = gyrostat.run(study, "fewer", trials=3, progress=False).outcomes()
        for name in ("bias_rmse", "nis"):
            self.assertEqual(fewer[name].tobytes(), finished[name][:len(fewer[name])].tobytes())
        self.assertTrue(os.path.exists("stopped/tables.md"))


if __name__ == "__main__":
    unittest.main()
