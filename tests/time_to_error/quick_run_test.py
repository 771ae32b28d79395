#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""quick_run_test.py FOLDER MIR   bench/time_to_error as its users meet it."""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.dom.minidom

folder, mir = sys.argv[1:3]
del sys.argv[1:3]


def run(output, *options):
    return subprocess.run([sys.executable, "-B", f"{folder}/time_to_error.py", "--mir", mir, "-o",
                           str(output), *options], text=True, capture_output=True, check=False)


class QuickRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.output = pathlib.Path(cls.place.name)
        cls.first = run(cls.output, "--quick")

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def rows(self):
        with open(self.output / "measurements.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_every_picture_has_a_row_for_each_layer(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        found = [(r["configuration"], r["value"], r["layer"]) for r in self.rows()]
        self.assertEqual(found, [(name, value, layer)
                                 for name, values in (("all pairs", "16 64"),
                                                      ("path tracer", "1 4"))
                                 for value in values.split() for layer in ("whole", "indirect")])

    def test_figures_are_possible(self):
        for r in self.rows():
            self.assertGreater(float(r["cpu_seconds"]), 0)
            self.assertGreater(float(r["wall_seconds"]), 0)
            self.assertLess(float(r["relmse_trimmed"]), 10)
        errors = {(r["configuration"], r["value"], r["layer"]): float(r["relmse"])
                  for r in self.rows()}
        for layer in ("whole", "indirect"):
            self.assertLess(errors["path tracer", "4", layer], errors["path tracer", "1", layer])

    def test_page_and_plot_are_there(self):
        text = (self.output / "time_to_error.md").read_text(encoding="utf-8")
        for part in ("builtin:cornell-box, indirect light alone", "| all pairs | ", "0.003"):
            self.assertIn(part, text)
        drawing = xml.dom.minidom.parse(str(self.output / "time_to_error.svg"))
        self.assertEqual(len(drawing.getElementsByTagName("title")), 4)

    def test_references_and_pictures_are_used_again(self):
        self.assertEqual(len(list((self.output / "references").glob("*.exr"))), 2)
        rows = self.rows()
        again = run(self.output, "--quick")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(again.stdout.strip(), str(self.output / "time_to_error.md"))
        self.assertEqual(self.rows(), rows)

    def test_what_fails_is_left_out_with_its_reason(self):
        result = run(self.output, "--quick", "--add", "odd: 1: --vpls 4 --filter odd {}")
        self.assertEqual(result.returncode, 0, result.stderr)
        text = (self.output / "time_to_error.md").read_text(encoding="utf-8")
        self.assertIn("## Left out", text)
        self.assertIn("* builtin:cornell-box: odd: ", text)

    def test_wrong_options_are_refused(self):
        self.assertIn("--only", run(self.output, "--quick", "--only", "nothing").stderr)
        self.assertIn("'a'", run(self.output, "--quick", "--add", "a").stderr)
        self.assertNotEqual(run(self.output, "builtin:none", "--only", "path").returncode, 0)
        self.assertIn("--mir", run(self.output, "--quick", "--mir", "/no/such").stderr)


if __name__ == "__main__":
    unittest.main()
