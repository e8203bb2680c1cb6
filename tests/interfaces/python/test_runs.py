"""Paths, fits and scenes: what the programs give, from files and dictionaries."""

import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest
import warnings

import numpy

import fpz
from support import DATA, needs, program


def quiet(function, *arguments, **keywords):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return function(*arguments, **keywords)


def numbers_of_csv(file):
    with open(file, newline="", encoding="utf-8") as f:
        rows = list(csv.DictReader(f))
    return {k: numpy.array([float(r[k]) for r in rows]) for k in rows[0] if k != "status"}


@needs("_run_tests")
class Paths(unittest.TestCase):
    FILE = DATA / "paths" / "four_stage.json"

    def test_the_history_is_the_drivers(self):
        driver = program("fpz-driver")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([driver, "run", self.FILE, "-o", folder, "--no-plots"], check=True, capture_output=True)
            written = numbers_of_csv(os.path.join(folder, "history.csv"))
        history = quiet(fpz.run_path, self.FILE).history
        self.assertEqual(set(history.dtype.names), set(written))
        for name in history.dtype.names:
            numpy.testing.assert_array_equal(history[name], written[name], name)

    def test_a_point_that_is_driven_by_hand_goes_the_same_way(self):
        """The four stages in steps of this test's own, against the history at every row."""
        history = quiet(fpz.run_path, self.FILE).history
        path = json.loads(self.FILE.read_text(encoding="utf-8"))
        rock = DATA / "materials" / "johnstone.json"
        material = quiet(fpz.Material, rock, rve_length=path["rve_length"], cohesive_zone="published")
        point, row, worst = fpz.Point(material), 0, 0.0
        for stage in path["stages"]:
            step = [stage["strain_increment"].get(c, 0.0) for c in ("xx", "yy", "xy")]
            for _ in range(stage["increments"]):
                point.update(step)
                row += 1
                expected = [history[row][c] for c in ("sig_xx", "sig_yy", "sig_xy")]
                worst = max(worst, numpy.abs(point.stress - expected).max() / 6e5)
                worst = max(worst, abs(point.damage - history[row]["D"]))
        self.assertEqual(row + 1, len(history))
        self.assertGreater(point.damage, 0.9)
        self.assertLess(worst, 1e-11)

    def test_a_dictionary_with_numpy_in_it(self):
        path = json.loads(self.FILE.read_text(encoding="utf-8"))
        path["stages"] = [{"increments": numpy.int64(100), "strain_increment": {"xx": numpy.float64(3e-5)}}]
        result = quiet(fpz.run_path, path, folder=self.FILE.parent)
        self.assertEqual(len(result.history), 101)
        self.assertGreater(result.history["D"][-1], 0.1)
        self.assertEqual(result.summary["status"], "ok")

    def test_several_tests(self):
        results = quiet(fpz.run_paths, DATA / "paths" / "several_tests.json")
        self.assertGreater(len(results), 1)
        self.assertTrue(all(r.ok and r.name == name for name, r in results.items()))
        with self.assertRaisesRegex(ValueError, "use run_paths"):
            quiet(fpz.run_path, DATA / "paths" / "several_tests.json")

    def test_mistakes_are_named(self):
        path = json.loads(self.FILE.read_text(encoding="utf-8"))
        path["stages"][1]["incremnts"] = 3
        with self.assertRaisesRegex(fpz.InputError, r'stages\[1\]\.incremnts: .*did you mean "increments"') as caught:
            fpz.run_path(path, folder=self.FILE.parent)
        self.assertNotIn(":1:", str(caught.exception))
        path["stages"][1] = {"increments": 3, "strain_increment": {"xx": float("nan")}}
        with self.assertRaisesRegex(fpz.InputError, r"stages\[1\].strain_increment.xx: nan"):
            fpz.run_path(path, folder=self.FILE.parent)

    def test_a_run_that_fails_keeps_what_there_is(self):
        file = DATA / "paths" / "snap_back.json"
        with self.assertRaisesRegex(fpz.RunError, "snap_back") as caught:
            quiet(fpz.run_path, file)
        self.assertGreater(len(caught.exception.result.history), 2)
        self.assertEqual(quiet(fpz.run_path, file, check=False).status, "snap_back")

    def test_warnings_are_at_the_callers_line(self):
        with self.assertWarnsRegex(fpz.FpzWarning, "johnstone.json:15: shear_stiffness") as caught:
            fpz.run_path(self.FILE)
        self.assertEqual(os.path.basename(caught.filename), "test_runs.py")

    def test_progress_is_told_and_can_stop(self):
        path = json.loads(self.FILE.read_text(encoding="utf-8"))
        path["stages"] = [{"increments": 3000000, "strain_increment": {"xx": 1e-12}}]
        told = []

        class Enough(Exception):
            pass

        def progress(info):
            told.append(info)
            raise Enough

        with self.assertRaises(Enough):
            quiet(fpz.run_path, path, folder=self.FILE.parent, progress=progress)
        self.assertTrue(0.0 < told[0]["fraction"] < 1.0)


@needs("_calibrate")
class Fits(unittest.TestCase):
    FILE = DATA / "calibration" / "table1.json"

    def test_a_closed_form(self):
        """delta0 = K^2 (1 - nu^2)/(E sigma_t0)."""
        result = quiet(fpz.calibrate, self.FILE)
        k = 2.15e6 * numpy.sqrt(1e-3)
        expected = k**2 * (1 - 0.25**2) / 4e8 / 6e5
        self.assertAlmostEqual(result.material["delta0"] / expected, 1.0, delta=1e-9)
        self.assertAlmostEqual(result.curves["K_Ic"]["predicted"][0] / k, 1.0, delta=1e-9)
        self.assertEqual(result.status, "ok")
        made = quiet(fpz.Material, result.material, rve_length=0.004)
        self.assertEqual(made.parameters["delta0"], result.material["delta0"])

    def test_a_dictionary_and_files_of_the_report(self):
        specification = json.loads(self.FILE.read_text(encoding="utf-8"))
        specification["data"][0]["toughness"]["value"] *= 2
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "fit"
            result = quiet(fpz.calibrate, specification, folder=self.FILE.parent, out=out)
            self.assertEqual(json.loads((out / "material.json").read_text(encoding="utf-8")), result.material)
            with self.assertRaises(fpz.OutputError):
                quiet(fpz.calibrate, specification, folder=self.FILE.parent, out=out)
        once = quiet(fpz.calibrate, self.FILE)
        self.assertAlmostEqual(result.material["delta0"] / once.material["delta0"], 4.0, delta=1e-9)

    def test_mistakes_are_named(self):
        with self.assertRaisesRegex(fpz.InputError, "no_such.json"):
            fpz.calibrate("no_such.json")
        specification = json.loads(self.FILE.read_text(encoding="utf-8"))
        specification["fit"] = ["delta_0"]
        with self.assertRaisesRegex(fpz.InputError, 'did you mean "delta0"'):
            fpz.calibrate(specification, folder=self.FILE.parent)


@needs("_run_scene")
class Scenes(unittest.TestCase):
    FILE = DATA / "scenes" / "beam_3pb.json"
    COARSE = {"spacing": 0.008, "output.frames": 3}

    def test_the_history_is_the_programs(self):
        sph = program("fpz-sph")
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [sph, self.FILE, "-o", folder, "--no-pictures", "--set", "spacing=0.008", "--set", "output.frames=3"],
                check=True, capture_output=True,
            )  # fmt: skip
            written = numbers_of_csv(os.path.join(folder, "history.csv"))
        result = quiet(fpz.run_scene, self.FILE, overrides=self.COARSE)
        for name in result.history.dtype.names:
            numpy.testing.assert_array_equal(result.history[name], written[name], name)
        self.assertTrue(result.ok)
        self.assertEqual(result.summary["peak_load"], result.history["load"].max())
        self.assertGreater(len(result.crack), 2)

    def test_frames_and_going_on(self):
        scene = json.loads(self.FILE.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            keywords = dict(folder=self.FILE.parent, overrides=self.COARSE)
            begun = quiet(fpz.run_scene, scene, out=folder, most_steps=500, **keywords)
            self.assertEqual(begun.status, "interrupted")
            on = quiet(fpz.run_scene, scene, out=folder, resume=True, **keywords)
            frame = fpz.read_frame(on.frames[-1][1])
            with self.assertRaises(fpz.OutputError):
                quiet(fpz.run_scene, scene, out=folder, **keywords)
        whole = quiet(fpz.run_scene, scene, **keywords)
        numpy.testing.assert_array_equal(on.history["load"], whole.history["load"])
        self.assertEqual(whole.frames, [])
        count = len(frame["points"])
        self.assertEqual((frame["points"].shape, frame["stress_xx"].shape), ((count, 3), (count,)))
        self.assertGreater(frame["damage"].max(), 0.9)

    def test_mistakes_are_named(self):
        with self.assertRaisesRegex(fpz.InputError, "spacng"):
            fpz.run_scene(self.FILE, overrides={"spacng": 1})


if __name__ == "__main__":
    unittest.main()
