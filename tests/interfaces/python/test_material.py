"""Materials: from files, dictionaries and keywords; what is wrong is said with its place."""

import math
import unittest
import warnings

import numpy

import fpz
from support import DATA, ROCK, rock


class Statements(unittest.TestCase):
    def test_keywords_dictionary_and_file_say_the_same(self):
        file = DATA / "materials" / "marble.json"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            whole = fpz.Material(file, rve_length=0.001)
            parameters = {k: v for k, v in whole.parameters.items() if k != "rve_length"}
            for other in (
                fpz.Material(str(file), rve_length=0.001),
                fpz.Material(parameters, rve_length=0.001),
                fpz.Material(**parameters, rve_length=0.001),
            ):
                self.assertEqual(other.parameters, whole.parameters)

    def test_keywords_replace_what_the_source_says(self):
        changed = fpz.Material(ROCK, rve_length=0.004, cohesion=2e6)
        self.assertEqual(changed.parameters, {**rock().parameters, "cohesion": 2e6})
        self.assertEqual(rock(softening="bilinear").parameters["softening"], "bilinear")

    def test_quantities_that_stand_for_parameters_are_converted(self):
        stated = {k: v for k, v in ROCK.items() if k not in ("young_modulus", "poisson_ratio", "delta0")}
        m = fpz.Material(stated, K={"value": 1.0, "unit": "GPa"}, G=0.5e9, fracture_energy=12.0, rve_length=0.004)
        self.assertAlmostEqual(m.parameters["young_modulus"] / (9 * 1e9 * 0.5e9 / (3e9 + 0.5e9)), 1.0, delta=1e-12)
        self.assertAlmostEqual(m.parameters["delta0"] / (12.0 / 6e5), 1.0, delta=1e-12)
        self.assertTrue(any("young_modulus" in note for note in m.notes), m.notes)

    def test_numbers_of_numpy_are_numbers(self):
        self.assertEqual(rock(cohesion=numpy.float32(2e6)).parameters["cohesion"], 2e6)

    def test_integrator(self):
        self.assertEqual(rock().integrator["name"], "accurate")
        self.assertEqual(rock(integrator="implicit").integrator["name"], "implicit")
        options = rock(integrator={"tolerance": 1e-8, "preferred_normal": [0, 1, 0]}).integrator
        self.assertEqual(options["tolerance"], 1e-8)
        self.assertEqual(list(options["preferred_normal"]), [0, 1, 0])

    def test_elastic_tangent_is_that_of_the_setting(self):
        e, nu = 4e8, 0.25
        stress = rock(setting="plane_stress").elastic_tangent()
        strain = rock().elastic_tangent()
        solid = rock(setting="3d").elastic_tangent()
        self.assertAlmostEqual(stress[0, 0] / (e / (1 - nu**2)), 1.0, delta=1e-12)
        self.assertAlmostEqual(strain[0, 0] / (e * (1 - nu) / (1 + nu) / (1 - 2 * nu)), 1.0, delta=1e-12)
        self.assertAlmostEqual(stress[2, 2] / (e / (1 + nu)), 1.0, delta=1e-12)  # tensor shear strain
        self.assertEqual(solid.shape, (6, 6))
        numpy.testing.assert_array_equal(solid[:2, :2], strain[:2, :2])

    def test_another_length(self):
        m = rock().with_rve_length(0.001)
        self.assertEqual(m.rve_length, 0.001)
        self.assertEqual({**m.parameters, "rve_length": 0.004}, rock().parameters)
        self.assertEqual(rock().rve_length, 0.004)


class Mistakes(unittest.TestCase):
    def expect(self, pattern, **arguments):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with self.assertRaisesRegex(fpz.InputError, pattern):
                fpz.Material(**{**ROCK, "rve_length": 0.004, **arguments})

    def test_each_is_named_with_its_key_and_a_way_out(self):
        self.expect(r"cohesion = 1e\+05: .*tan", cohesion=1e5)
        self.expect('unknown key "young_modulus_"; did you mean "young_modulus"', young_modulus_=1.0)
        self.expect('cohesion: expected a number, found the string "high"', cohesion="high")
        self.expect("cohesion: nan is not a number", cohesion=math.nan)
        self.expect("cohesion: a set is neither", cohesion={1})
        self.expect("rve_length = -1: ", rve_length=-1.0)
        self.expect("rve_length is missing", rve_length=None)
        self.expect('setting: "plane_strian"; did you mean "plane_strain"', setting="plane_strian")
        self.expect('integrator: "tolerence" is no option; did you mean "tolerance"', integrator={"tolerence": 1})
        self.expect('integrator: name: "exact"', integrator="exact")
        self.expect("tolerance", integrator={"tolerance": -1.0})
        self.expect('"paper"|paper', integrator="paper", cohesive_zone="consistent")

    def test_all_are_found_at_once(self):
        with self.assertRaises(fpz.InputError) as caught:
            fpz.Material(young_modulus=4e8, rve_length=0.004)
        self.assertEqual(len(str(caught.exception).splitlines()), 9)
        self.assertIsInstance(caught.exception, ValueError)

    def test_a_file_is_named_with_the_line(self):
        with self.assertRaisesRegex(fpz.InputError, "no_such.json.*No such file"):
            fpz.Material("no_such.json", rve_length=0.004)

    def test_what_is_doubtful_is_warned_about_where_it_is_written(self):
        with self.assertWarnsRegex(fpz.FpzWarning, "rve_length = 0.4: ") as caught:
            m = fpz.Material(**ROCK, rve_length=0.4)
        self.assertTrue(caught.filename.endswith("test_material.py"))
        self.assertLess(m.snap_back_length, 0.4)
        self.assertEqual(len(m.warnings), 1)

    def test_warnings_can_be_errors(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(fpz.FpzWarning):
                fpz.Material(**ROCK, rve_length=0.4)


if __name__ == "__main__":
    unittest.main()
