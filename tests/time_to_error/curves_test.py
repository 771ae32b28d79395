#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""curves_test.py FOLDER   what bench/time_to_error concludes from measurements."""

import pathlib
import sys
import tempfile
import unittest
import xml.dom.minidom

sys.path.insert(0, sys.argv.pop(1))

import configurations
import curves
import page
import plot
import tables
from curves import Point

TINY = 1e-12


def row(value, seconds, error, configuration="plain", seed=1, group="plain"):
    return tables.Row("builtin:a", "key", 8, 6, "whole", configuration, group, value, seed,
                      seconds, 2 * seconds, 10.0, 2 * error, error)


class Curves(unittest.TestCase):
    def test_a_power_law_is_interpolated_exactly(self):
        points = [Point(n, 0.5 * n, 1.0 / n) for n in (1, 4, 16, 64)]
        for level in (0.3, 0.1, 0.03):
            reached = curves.seconds_to(points, level, TINY)
            self.assertAlmostEqual(reached.seconds, 0.5 / level)
            self.assertFalse(reached.is_bound)
        self.assertAlmostEqual(curves.slope(points), -1.0)

    def test_order_does_not_matter_and_the_first_crossing_counts(self):
        points = [Point(16, 8, 0.5), Point(1, 1, 1.0), Point(4, 2, 0.1)]
        self.assertLess(curves.seconds_to(points, 0.2, TINY).seconds, 2)

    def test_a_first_picture_that_is_better_is_a_bound(self):
        reached = curves.seconds_to([Point(1, 3, 0.05), Point(2, 6, 0.01)], 0.1, TINY)
        self.assertEqual(reached, curves.Reached(3, is_bound=True))

    def test_what_is_not_reached_is_none(self):
        self.assertIsNone(curves.seconds_to([Point(1, 3, 0.5), Point(2, 6, 0.2)], 0.1, TINY))

    def test_estimates_below_zero_count_as_the_smallest_error(self):
        points = [Point(1, 1, 1.0), Point(2, 100, -0.1)]
        self.assertAlmostEqual(curves.seconds_to(points, 0.1, 0.01).seconds, 10.0)
        self.assertIsNone(curves.slope(points))


class Tables(unittest.TestCase):
    def test_points_are_means_over_seeds(self):
        rows = [row(1, 1.0, 0.2), row(1, 3.0, 0.4, seed=2), row(2, 5.0, 0.1)]
        points = tables.points_of(rows, "relmse_trimmed", "cpu_seconds")
        self.assertEqual([p.value for p in points], [1, 2])
        self.assertAlmostEqual(points[0].seconds, 2.0)
        by_clock = tables.points_of(rows, "relmse_trimmed", "wall_seconds")
        self.assertAlmostEqual(by_clock[0].seconds, 4.0)
        self.assertAlmostEqual(points[0].error, 0.3)
        self.assertAlmostEqual(tables.points_of(rows, "relmse", "cpu_seconds")[0].error, 0.6)

    def test_a_table_tells_seconds_bounds_and_limits(self):
        found = tables.curves_of([row(1, 1.0, 0.05), row(2, 2.0, 0.01)], "relmse_trimmed",
                                  "cpu_seconds")
        cells = tables.level_table(found, (0.1, 0.01, 0.001), TINY)[2].split(" | ")
        self.assertEqual(cells[:4], ["| plain", "≤ 1", "2", "not reached in 2 s"])

    def test_what_the_references_do_not_tell_is_not_told(self):
        found = tables.curves_of([row(1, 1.0, 0.05), row(2, 2.0, 0.001, "b")], "relmse_trimmed",
                                  "cpu_seconds")
        lines = tables.level_table(found, (0.1, 0.01), page.smallest_error(0.2))
        self.assertTrue(all(line.split(" | ")[2] == "not told" for line in lines[2:]))
        self.assertAlmostEqual(page.smallest_error(0.2), 0.06)
        self.assertAlmostEqual(page.smallest_error(0.001), 1e-5)

    def test_the_best_of_a_group_is_named_level_by_level(self):
        rows = [row(1, 1.0, 0.1, "a"), row(2, 9.0, 0.01, "a"), row(1, 2.0, 0.1, "b"),
                row(2, 4.0, 0.01, "b"), row(1, 0.1, 0.001, "c", group="other")]
        found = tables.curves_of(rows, "relmse_trimmed", "cpu_seconds")
        lines = tables.level_table(found, (0.1, 0.01), TINY)
        self.assertEqual(len(lines), 2 + 3 + 1)
        self.assertIn("**≤ 1** (a) | **4** (b)", lines[-1])

    def test_rows_survive_their_file(self):
        rows = [row(1, 0.123456789, 1e-9, "with, comma"), row(2, 1.0, -0.5)]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rows.csv"
            self.assertEqual(tables.read_rows(path), [])
            tables.write_rows(path, rows)
            self.assertEqual(tables.read_rows(path), rows)


class Pages(unittest.TestCase):
    def test_page_and_plot_hold_every_curve(self):
        rows = [row(1, 1.0, 0.1, "a <b>"), row(2, 9.0, 0.01, "a <b>"), row(1, 1.0, -0.1, "c")]
        results = {("builtin:a", "whole"): (rows, 1e-4)}
        with tempfile.TemporaryDirectory() as folder:
            text, drawing = (pathlib.Path(folder) / name for name in ("p.md", "p.svg"))
            page.write(text, results, [("builtin:a", "d", "no such program")], "relmse_trimmed",
                       "wall_seconds", tables.LEVELS)
            plot.write(drawing, results, "relmse_trimmed", "wall_seconds")
            words = text.read_text(encoding="utf-8")
            for part in ("builtin:a, whole picture", "by the clock", "0.0001", "* builtin:a: d: no such program"):
                self.assertIn(part, words)
            titles = xml.dom.minidom.parse(str(drawing)).getElementsByTagName("title")
            self.assertEqual([t.firstChild.data for t in titles], ["a <b>"])


class Configurations(unittest.TestCase):
    def test_names_are_unique_and_values_grow(self):
        usual = configurations.standard()
        self.assertEqual(len({c.name for c in usual}), len(usual))
        for c in usual:
            self.assertEqual(list(c.values), sorted(set(c.values)), c.name)

    def test_values_take_their_place_in_the_options(self):
        path = [c for c in configurations.standard() if c.name == "path tracer"][0]
        self.assertEqual(path.options_at(4)[-4:], ["--luxels", "4", "--samples", "1"])
        self.assertEqual(path.options_at(256)[-4:], ["--luxels", "64", "--samples", "4"])
        quality = [c for c in configurations.standard() if c.name == "quality"][0]
        self.assertEqual([quality.options_at(value)[-1] for value in quality.values],
                         ["draft", "good", "final"])

    def test_added_ones_are_parsed_or_refused(self):
        added = configurations.parsed("cuts, 32: 4096,1024: --picks 32 --vpls {}")
        self.assertEqual(added.name, "cuts, 32")
        self.assertEqual(added.group, "cuts")
        self.assertEqual(added.values, (1024, 4096))
        self.assertEqual(added.options_at(1024), ["--picks", "32", "--vpls", "1024"])
        for bad in ("a", "a: 1: --vpls 5", ": 1: --vpls {}", "a: x: --vpls {}"):
            with self.assertRaises(ValueError):
                configurations.parsed(bad)


if __name__ == "__main__":
    unittest.main()
