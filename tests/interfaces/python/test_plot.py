"""Pictures, where matplotlib is there, and the examples that draw them."""

import os
import pathlib
import subprocess
import tempfile
import unittest
import warnings

import numpy

import fpz
from support import DATA, needs, rock

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
except ImportError as missing:
    raise unittest.SkipTest("matplotlib is not there") from missing

EXAMPLES = pathlib.Path(os.environ["FPZ_EXAMPLES"])


class Pictures(unittest.TestCase):
    def tearDown(self):
        pyplot.close("all")

    def test_the_yield_surface_is_the_librarys(self):
        material = rock()
        line = fpz.plot.yield_surface(material).lines[0]
        count = 0
        for normal, shear in line.get_xydata()[::40]:
            value = fpz.failure_values(material, [normal, 0.0, shear], [[1.0, 0.0]])[0]
            self.assertLess(abs(value), 1e-9 * 1e6)
            count += 1
        self.assertGreater(count, 10)

    @needs("_run_tests")
    def test_history(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            result = fpz.run_path(DATA / "paths" / "four_stage.json")
        axes = fpz.plot.history(result, "time", "sig_xx", "D")
        numpy.testing.assert_array_equal(axes.lines[1].get_ydata(), result.history["D"])
        with self.assertRaisesRegex(ValueError, 'no column "sigma"; there are stage'):
            fpz.plot.history(result, "time", "sigma")

    @needs("_calibrate")
    def test_calibration(self):
        axes = fpz.plot.calibration(fpz.calibrate(DATA / "calibration" / "table1.json"))
        self.assertEqual(len(axes.lines), 2)

    @needs("_run_scene")
    def test_crack_and_frame(self):
        with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
            warnings.simplefilter("ignore")
            overrides = {"spacing": 0.008, "output.frames": 2}
            result = fpz.run_scene(DATA / "scenes" / "beam_3pb.json", overrides=overrides, out=folder)
            particles = fpz.read_frame(result.frames[-1][1])
        self.assertGreaterEqual(len(fpz.plot.crack(result).lines), 1)
        drawn = fpz.plot.frame(particles).collections[0]
        numpy.testing.assert_array_equal(drawn.get_array(), particles["damage"])


class Examples(unittest.TestCase):
    @needs("_run_tests")
    def test_four_stages(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "figure.png")
            command = [os.environ["FPZ_PYTHON"], EXAMPLES / "four_stage.py", DATA, picture]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("D = 0.927033", run.stdout)
            self.assertGreater(os.path.getsize(picture), 10000)


if __name__ == "__main__":
    unittest.main()
