"""One point: its update, tangent, energies, jump control, onset."""

import json
import os
import subprocess
import tempfile
import threading
import unittest

import numpy

import fpz
from support import program, rock, walks


def walked(material, seed=1, steps=20):
    """A cracked point after a walk, and one more increment for it."""
    for k in range(seed, seed + 50):
        point = fpz.Point(material)
        increments = walks(material, 1, steps, k)[:, 0]
        try:
            for d in increments:
                point.update(d)
            point.copy().update(increments[0])
        except fpz.UpdateError:
            continue
        if point.cracked:
            return point, increments[0]
    raise AssertionError("no walk cracks")


class Updates(unittest.TestCase):
    def test_elastic_before_onset(self):
        point = fpz.Point(rock())
        d = numpy.array([1e-4, -2e-4, 3e-5])
        report = point.update(d)
        numpy.testing.assert_allclose(point.stress, rock().elastic_tangent() @ d, rtol=1e-14)
        numpy.testing.assert_array_equal(point.strain, d)
        self.assertAlmostEqual(point.stress_zz / (0.25 * (point.stress[0] + point.stress[1])), 1.0, delta=1e-14)
        self.assertFalse(point.cracked or report.onset)
        self.assertIsNone(point.normal)
        self.assertEqual(point.damage, 0.0)

    def test_uniaxial_strain_dissipates_the_fracture_energy(self):
        point = fpz.Point(rock())
        for _ in range(4000):
            point.update([1e-5, 0.0, 0.0])
        self.assertGreater(point.damage, 0.99)
        numpy.testing.assert_allclose(point.normal, [1.0, 0.0], atol=1e-12)
        energy = point.dissipated_energy * 0.004
        self.assertAlmostEqual(energy / (6e5 * 1.8e-5), point.damage, delta=0.01)

    def test_tangent_is_the_derivative_of_the_update(self):
        for setting in ("plane_strain", "plane_stress", "3d"):
            for integrator in ("accurate", "implicit"):
                point, d = walked(rock(setting=setting, integrator={"name": integrator, "tolerance": 1e-10}))
                after = point.copy()
                after.update(d)
                tangent = after.tangent
                differences = numpy.empty_like(tangent)
                h = 1e-8
                for j in range(len(d)):
                    step = h * numpy.eye(len(d))[j]
                    up, down = point.copy(), point.copy()
                    up.update(d + step)
                    down.update(d - step)
                    differences[:, j] = (up.stress - down.stress) / (2 * h)
                error = numpy.linalg.norm(tangent - differences) / numpy.linalg.norm(tangent)
                self.assertLess(error, 1e-5, (setting, integrator))
                self.assertGreater(numpy.linalg.norm(tangent - rock(setting=setting).elastic_tangent()), 1e6)

    def test_tangent_of_a_fresh_point_is_elastic(self):
        numpy.testing.assert_array_equal(fpz.Point(rock()).tangent, rock().elastic_tangent())

    def test_work_is_stored_or_dissipated(self):
        material = rock()
        point, work = fpz.Point(material), 0.0
        for d in numpy.repeat(walks(material, 1, 12)[:, 0], 200, axis=0) / 200:
            before = point.stress
            point.update(d)
            work += 0.5 * (before + point.stress) @ (d * [1, 1, 2])
        self.assertTrue(point.cracked)
        self.assertAlmostEqual((point.stored_energy + point.dissipated_energy) / work, 1.0, delta=1e-3)

    def test_jump_control_follows_what_snaps_back(self):
        material = rock().with_rve_length(0.4)
        self.assertLess(material.snap_back_length, 0.4)
        with self.assertRaisesRegex(fpz.UpdateError, "snap_back.*rve_length") as caught:
            point = fpz.Point(material)
            for _ in range(2000):
                point.update([1e-5, 0.0, 0.0])
        self.assertEqual(caught.exception.status, "snap_back")
        point = fpz.Point(material)
        factors = [point.update_controlled([1.0, 0.0, 0.0], 1e-7) for _ in range(500)]
        self.assertGreater(factors[0], 0.0)
        self.assertLess(factors[1], 0.0)
        self.assertAlmostEqual(point.jump[0] / 5e-5, 1.0, delta=0.01)
        self.assertGreater(point.damage, 0.9)
        with self.assertRaisesRegex(ValueError, "belongs to a strain increment"):
            point.tangent

    def test_state_can_be_kept_and_put_back(self):
        point, d = walked(rock())
        kept = point.state
        point.update(d)
        stress = point.stress
        point.state = kept
        point.update(d)
        numpy.testing.assert_array_equal(point.stress, stress)
        numpy.testing.assert_array_equal(kept["frame"][:, 0], point.normal)

    def test_mistakes(self):
        point = fpz.Point(rock())
        with self.assertRaisesRegex(ValueError, r"strain_increment has the shape \(2,\)"):
            point.update([1e-5, 0.0])
        with self.assertRaisesRegex(TypeError, "array of 3 numbers"):
            point.update("abc")
        with self.assertRaisesRegex(fpz.UpdateError, "invalid_input"):
            point.update([numpy.nan, 0.0, 0.0])
        with self.assertRaisesRegex(TypeError, "the state must be a record"):
            point.state = 3
        with self.assertRaisesRegex(TypeError, "the state must be a record"):
            point.state = fpz.Point(rock(setting="3d")).state
        broken = rock().fresh_states(1)
        broken["cracked"] = True
        broken["frame"] = 0.5
        with self.assertRaisesRegex(ValueError, "not a state"):
            point.state = broken[0]
        with self.assertRaises(TypeError):
            fpz.Point(None)
        numpy.testing.assert_array_equal(point.strain, [0, 0, 0])

    def test_a_failing_point_is_captured_and_replayed(self):
        driver = program("fpz-driver")
        script = (
            "import fpz, json, sys\n"
            "point = fpz.Point(fpz.Material(json.loads(sys.argv[1]), rve_length=0.4))\n"
            "for _ in range(2000): point.update([1e-5, 0, 0])\n"
        )
        parameters = json.dumps({k: v for k, v in rock().parameters.items() if k != "rve_length"})
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [os.environ["FPZ_PYTHON"], "-W", "ignore", "-c", script, parameters],
                env={**os.environ, "FPZ_CAPTURE": folder}, capture_output=True, text=True, check=False,
            )  # fmt: skip
            self.assertIn("UpdateError: snap_back", run.stderr)
            files = os.listdir(folder)
            self.assertEqual(len(files), 1, files)
            self.assertIn(files[0], run.stderr)
            replay = subprocess.run(
                [driver, "replay", os.path.join(folder, files[0])], capture_output=True, text=True, check=False
            )
            self.assertEqual(replay.returncode, 1)
            self.assertIn("snap_back", replay.stdout)


class Onset(unittest.TestCase):
    def test_scan_finds_the_plane_of_the_closed_form(self):
        material = rock()
        stress = numpy.array([2e5, -8e5, 4e5])
        plane = fpz.critical_plane(material, stress)
        angles = numpy.radians(numpy.arange(0.0, 180.0, 0.01))
        normals = numpy.column_stack([numpy.cos(angles), numpy.sin(angles)])
        values = fpz.failure_values(material, stress, normals)
        self.assertAlmostEqual(values.max() / plane["failure_value"], 1.0, delta=1e-6)
        best = normals[numpy.argsort(values)[-1]]
        conjugate = fpz.failure_values(material, stress, [plane["normal"]])[0]
        self.assertAlmostEqual(conjugate / plane["failure_value"], 1.0, delta=1e-9)
        traction = numpy.array([[stress[0], stress[2]], [stress[2], stress[1]]]) @ plane["normal"]
        self.assertAlmostEqual(plane["traction"][0] / (traction @ plane["normal"]), 1.0, delta=1e-12)
        self.assertLess(numpy.degrees(numpy.arccos(abs(best @ plane["normal"]))) % 180.0, 90.0)
        scanned = fpz.critical_plane(material, stress, scan_degrees=0.1)
        self.assertAlmostEqual(scanned["failure_value"] / plane["failure_value"], 1.0, delta=1e-4)

    def test_the_point_cracks_on_that_plane(self):
        for setting in ("plane_strain", "3d"):
            material = rock(setting=setting)
            point = fpz.Point(material)
            d = numpy.array([1e-8, -3e-8, 2e-8, 1e-8, 0, 5e-9][: 3 if material.dim == 2 else 6])
            point.update(1e4 * d)
            self.assertFalse(point.cracked)
            before = point.stress
            while not point.cracked:
                before = point.stress
                report = point.update(d)
            self.assertTrue(report.onset)
            self.assertLess(fpz.critical_plane(material, before)["failure_value"], 0.0)
            normal = fpz.critical_plane(material, before)["normal"]
            self.assertGreater(abs(normal @ point.normal), 1 - 1e-9)

    def test_mistakes(self):
        with self.assertRaisesRegex(ValueError, r"normals has the shape \(1, 3\); it must be \(count, 2\)"):
            fpz.failure_values(rock(), [0, 0, 0], [[1, 0, 0]])
        with self.assertRaisesRegex(ValueError, "no direction"):
            fpz.failure_values(rock(), [0, 0, 0], [[0, 0]])
        with self.assertRaisesRegex(ValueError, "not finite"):
            fpz.critical_plane(rock(), [numpy.inf, 0, 0])


class Threads(unittest.TestCase):
    def test_points_of_one_material_in_many_threads(self):
        material = rock(setting="3d")
        increments = walks(material, 8, 15)

        def walk(k):
            point, failures = fpz.Point(material), 0
            for d in increments[:, k]:
                try:
                    point.update(d)
                except fpz.UpdateError:
                    failures += 1
            return [point.damage, failures, *point.stress]

        expected = [walk(k) for k in range(8)]
        self.assertGreater(sum(e[0] > 0.0 for e in expected), 2)
        results = [None] * 8

        def run(k):
            for _ in range(20):
                results[k] = walk(k)

        threads = [threading.Thread(target=run, args=(k,)) for k in range(8)]
        for t in threads:
            t.start()
        for t in threads:
            t.join()
        numpy.testing.assert_array_equal(results, expected)


if __name__ == "__main__":
    unittest.main()
