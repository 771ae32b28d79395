#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""bench_compare_test.py PROGRAM   tools/bench_compare as its users meet it."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

program = None


class Comparison(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, unit="ms", **figures):
        rows = [{"name": n, "run_name": n, "run_type": "iteration", "real_time": t,
                 "items_per_second": 1 / t, "time_unit": unit}
                for n, times in figures.items() for t in times]
        rows.append({"name": "a_mean", "run_name": "a", "run_type": "aggregate", "real_time": 1e9})
        path = self.folder / name
        path.write_text(json.dumps({"benchmarks": rows}))
        return str(path)

    def run_on(self, *arguments):
        return subprocess.run([sys.executable, program, *map(str, arguments)], text=True,
                              capture_output=True, check=False)

    def assert_refused(self, result, *words):
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, "")
        self.assertTrue(result.stderr.startswith("bench_compare: "))
        for word in words:
            self.assertIn(word, result.stderr)

    def test_equal_runs_are_not_slower(self):
        old = self.write("old", a=[10, 11, 10], b=[5, 5, 5])
        result = self.run_on(old, old)
        self.assertEqual(result.returncode, 0)
        self.assertIn("1.000", result.stdout)
        self.assertNotIn("slower", result.stdout)

    def test_a_slower_benchmark_gives_code_1_and_is_named(self):
        old = self.write("old", a=[10, 10, 10], b=[5, 5, 5])
        new = self.write("new", a=[10, 10, 10], b=[6, 6, 6])
        result = self.run_on(old, new)
        self.assertEqual(result.returncode, 1)
        line = [x for x in result.stdout.splitlines() if x.startswith("b ")][0]
        self.assertIn("1.200", line)
        self.assertTrue(line.endswith("slower"))
        self.assertEqual(self.run_on(new, old).returncode, 0)
        self.assertIn("faster", self.run_on(new, old).stdout)

    def test_changes_below_threshold_or_spread_are_noise(self):
        old = self.write("old", a=[100, 100, 100])
        new = self.write("new", a=[104, 104, 104])
        self.assertEqual(self.run_on(old, new).returncode, 0)
        self.assertEqual(self.run_on(old, new, "--threshold", "0.03").returncode, 1)
        noisy = self.write("noisy", a=[80, 130, 110, 95, 140])
        self.assertEqual(self.run_on(old, noisy).returncode, 0)

    def test_one_slow_repetition_moves_nothing(self):
        old = self.write("old", a=[10, 10, 10, 10, 10])
        new = self.write("new", a=[10, 10, 90, 10, 10])
        self.assertEqual(self.run_on(old, new).returncode, 0)

    def test_units_of_time_are_brought_to_one(self):
        old = self.write("old", a=[10, 10, 10])
        new = self.write("new", unit="us", a=[10000, 10000, 10000])
        self.assertIn("1.000", self.run_on(old, new).stdout)

    def test_rates_are_better_when_they_are_larger(self):
        old = self.write("old", a=[10, 10, 10])
        new = self.write("new", a=[20, 20, 20])
        rate = ("--metric", "items_per_second", "--more-is-better")
        self.assertEqual(self.run_on(old, new, *rate).returncode, 1)
        self.assertEqual(self.run_on(new, old, *rate).returncode, 0)

    def test_a_baseline_takes_the_machine_out(self):
        old = self.write("old", plain=[10, 10, 10], fast=[2, 2, 2])
        new = self.write("new", plain=[20, 20, 20], fast=[4, 4, 4])
        self.assertEqual(self.run_on(old, new).returncode, 1)
        self.assertEqual(self.run_on(old, new, "--baseline", "^plain$").returncode, 0)
        self.assert_refused(self.run_on(old, new, "--baseline", "a"), "fits 2", "plain, fast")

    def test_what_only_one_run_has_is_named(self):
        old = self.write("old", a=[1, 1, 1], gone=[1, 1, 1])
        new = self.write("new", a=[1, 1, 1], added=[1, 1, 1])
        out = self.run_on(old, new).stdout
        self.assertRegex(out, r"gone +only in .*old")
        self.assertRegex(out, r"added +only in .*new")

    def test_bad_files_and_options_are_refused(self):
        good = self.write("good", a=[1, 1, 1])
        other = self.write("other", b=[1, 1, 1])
        text = self.folder / "text"
        text.write_text("benchmarks")
        zero = self.write("zero", a=[1])
        pathlib.Path(zero).write_text(pathlib.Path(zero).read_text().replace('e": 1,', 'e": 0,'))
        self.assert_refused(self.run_on(good, self.folder / "none"), "none", "--benchmark_out")
        self.assert_refused(self.run_on(good, text), "text", "not the JSON")
        self.assert_refused(self.run_on(good, zero), "zero", "'a'", "positive")
        self.assert_refused(self.run_on(good, other), "in common")
        self.assert_refused(self.run_on(good, good, "--metric", "bytes"), "'bytes'")
        self.assert_refused(self.run_on(good, good, "--threshold", "-1"), "--threshold -1.0")


if __name__ == "__main__":
    program = sys.argv.pop(1)
    unittest.main()
