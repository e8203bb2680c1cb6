"""Batches: the same bits as single points, on the caller's memory, other threads running."""

import threading
import time
import unittest

import numpy

import fpz
from support import rock, walks


class Results(unittest.TestCase):
    def test_equal_to_single_points_to_the_bit(self):
        for setting in ("plane_strain", "plane_stress", "3d"):
            material = rock(setting=setting)
            increments = walks(material, 40, 12)
            states, tangents = material.fresh_states(40), material.fresh_tangents(40)
            points = [fpz.Point(material) for _ in range(40)]
            for step in increments:
                report = fpz.update_batch(material, states, step, tangents=tangents, threads=2, check=False)
                failed = 0
                for k, point in enumerate(points):
                    try:
                        point.update(step[k])
                        numpy.testing.assert_array_equal(tangents[k], point.tangent)
                    except fpz.UpdateError:
                        failed += 1
                    self.assertEqual(states[k].tobytes()[: 49], point.state.tobytes()[: 49])
                    for field in ("strain", "stress", "cracked"):
                        numpy.testing.assert_array_equal(states[k][field], point.state[field])
                    if point.cracked:
                        for field in ("frame", "jump", "traction", "integrity", "dissipated", "slip"):
                            numpy.testing.assert_array_equal(states[k][field], point.state[field])
                self.assertEqual(report.failed, failed)
            self.assertGreater(report.cracked, 20)

    def test_the_memory_of_the_arrays_is_used(self):
        material = rock()
        states = material.fresh_states(3)
        end = material.fresh_states(3)
        address = end.__array_interface__["data"][0]
        fpz.update_batch(material, states, numpy.full((3, 3), 1e-5), end)
        self.assertEqual(end.__array_interface__["data"][0], address)
        self.assertEqual(states["stress"].max(), 0.0)
        self.assertGreater(end["stress"].min(), 0.0)

    def test_strided_inputs(self):
        material = rock()
        increments = walks(material, 12, 1)[0]
        expected = material.fresh_states(12)
        fpz.update_batch(material, expected, increments)
        every_second = numpy.empty((24, 3))
        every_second[::2] = increments
        for view in (every_second[::2], numpy.asfortranarray(increments)):
            end = material.fresh_states(12)
            fpz.update_batch(material, material.fresh_states(24)[::2], view, end)
            numpy.testing.assert_array_equal(end["stress"], expected["stress"])

    def test_no_points(self):
        material = rock()
        report = fpz.update_batch(material, material.fresh_states(0), numpy.empty((0, 3)))
        self.assertTrue(report.ok)
        self.assertIsNone(report.first_failed)

    def test_a_failing_point_is_named_and_keeps_its_state(self):
        material = rock()
        states = material.fresh_states(5)
        increments = numpy.full((5, 3), 1e-5)
        increments[3, 1] = numpy.nan
        with self.assertRaisesRegex(fpz.UpdateError, "1 of 5 points failed; point 3: invalid_input") as caught:
            fpz.update_batch(material, states, increments)
        self.assertEqual((caught.exception.index, caught.exception.status), (3, "invalid_input"))
        self.assertEqual(list(numpy.flatnonzero(states["stress"][:, 0])), [0, 1, 2, 4])
        report = fpz.update_batch(material, states, increments, check=False)
        self.assertEqual((report.failed, report.first_failed, report.first_status), (1, 3, "invalid_input"))

    def test_the_result_does_not_depend_on_the_number_of_threads(self):
        material = rock()
        results = []
        for threads in (1, 2, 4):
            states = material.fresh_states(500)
            for step in walks(material, 500, 6):
                fpz.update_batch(material, states, step, threads=threads, check=False)
            results.append(states["stress"].copy())
        self.assertGreater(numpy.count_nonzero(states["cracked"]), 100)
        numpy.testing.assert_array_equal(results[0], results[1])
        numpy.testing.assert_array_equal(results[0], results[2])


class Lock(unittest.TestCase):
    def test_other_threads_run_during_a_batch(self):
        """This thread ticks in the middle half of a call that another one is in: with the lock held it could not."""
        material = rock()
        states = material.fresh_states(40000)
        increments = numpy.repeat(walks(material, 200, 1)[0], 200, axis=0)
        times = []

        def batch():
            end = material.fresh_states(len(states))
            for _ in range(5):
                begin = time.perf_counter()
                fpz.update_batch(material, states, increments, end, threads=1, check=False)
                times.append((begin, time.perf_counter()))

        worker = threading.Thread(target=batch)
        ticks = []
        worker.start()
        while worker.is_alive():
            ticks.append(time.perf_counter())
        worker.join()
        self.assertEqual(len(times), 5)
        middles = [(0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b) for a, b in times]
        self.assertTrue(any(a < t < b for t in ticks for a, b in middles))


class Mistakes(unittest.TestCase):
    def setUp(self):
        self.material = rock()
        self.states = self.material.fresh_states(4)
        self.increments = numpy.zeros((4, 3))

    def expect(self, error, pattern, *arguments, **keywords):
        with self.assertRaisesRegex(error, pattern):
            fpz.update_batch(self.material, *arguments, **keywords)

    def test_types(self):
        self.expect(TypeError, "float32; it must be float64", self.states, self.increments.astype("f4"))
        self.expect(TypeError, "states has the type float64; make them with", self.increments, self.increments)
        solid = rock(setting="3d").fresh_states(4)
        self.expect(TypeError, "states has the type a record of other fields", solid, self.increments)
        swapped = self.increments.astype(">f8")
        self.expect(TypeError, "strain_increments has the type >f8", self.states, swapped)

    def test_shapes(self):
        wrong = r"strain_increments has the shape \(4, 6\); it must be \(4, 3\)"
        self.expect(ValueError, wrong, self.states, numpy.zeros((4, 6)))
        self.expect(ValueError, r"strain_increments has the shape \(3, 3\)", self.states, numpy.zeros((3, 3)))
        three = self.material.fresh_states(3)
        self.expect(ValueError, r"out has the shape \(3,\)", self.states, self.increments, three)
        self.expect(ValueError, r"states has the shape \(2, 2\)", self.states.reshape(2, 2), self.increments)

    def test_memory(self):
        frozen = self.material.fresh_states(4)
        frozen.flags.writeable = False
        self.expect(ValueError, "out is read-only", self.states, self.increments, frozen)
        self.expect(ValueError, "states .* is read-only", frozen, self.increments)
        fpz.update_batch(self.material, frozen, self.increments, self.states)
        long = self.material.fresh_states(8)
        self.expect(ValueError, "out is not contiguous", self.states, self.increments, long[::2])
        self.expect(ValueError, "out overlaps states", long[:4], self.increments, long[1:5])

    def test_tangents(self):
        arrays = self.states, self.increments
        self.expect(ValueError, "stored in another order", *arrays, tangents=numpy.zeros((4, 3, 3)))
        self.expect(ValueError, r"tangents has the shape \(4, 3\)", *arrays, tangents=self.increments)

    def test_records_that_are_no_states(self):
        self.states["cracked"] = [False, False, True, False]
        self.states["integrity"] = 2.0
        self.expect(ValueError, r"states\[2\] is not a state", self.states, self.increments)
        self.states["cracked"].view("u1")[...] = [0, 7, 0, 0]
        self.expect(ValueError, r"states\[1\] is not a state", self.states, self.increments)

    def test_threads(self):
        self.expect(ValueError, "threads", self.states, self.increments, threads=-1)


if __name__ == "__main__":
    unittest.main()
