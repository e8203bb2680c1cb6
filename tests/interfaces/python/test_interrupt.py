"""Ctrl-C ends a long run: with KeyboardInterrupt, in good time, leaving what a person needs to go on."""

import os
import signal
import subprocess
import tempfile
import unittest

from support import DATA, needs

PATH = """
import fpz, json
path = json.load(open(DATA + "/paths/four_stage.json"))
path["stages"] = [{"increments": 900000000, "strain_increment": {"xx": 1e-15}}]
run = lambda progress: fpz.run_path(path, folder=DATA + "/paths", progress=progress)
"""
SCENE = """
import fpz
overrides = {"spacing": 0.008, "boundaries[0].velocity.y.speed": -1e-9, "stop.time": 1000.0}
overrides.update({"output.frames": 0, "output.history_rows": 1000000})
run = lambda progress: fpz.run_scene(DATA + "/scenes/beam_3pb.json", overrides=overrides, out=OUT, progress=progress)
"""
MAIN = """
begun = []
def progress(info):
    if not begun: print("begun", flush=True)
    begun.append(info)
try:
    run(progress)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


class Interrupt(unittest.TestCase):
    def interrupted(self, script, out):
        code = f"DATA = {str(DATA)!r}\nOUT = {out!r}\n{script}{MAIN}"
        run = subprocess.Popen(
            [os.environ["FPZ_PYTHON"], "-W", "ignore", "-c", code], stdout=subprocess.PIPE, text=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )  # fmt: skip
        try:
            self.assertEqual(run.stdout.readline(), "begun\n")
            run.send_signal(signal.SIGINT)
            text, _ = run.communicate(timeout=60)  # the runs would take hours
        finally:
            run.kill()
            run.stdout.close()
            run.wait()
        self.assertEqual((text, run.returncode), ("interrupted\n", 0))

    @needs("_run_tests")
    def test_of_a_path(self):
        self.interrupted(PATH, "")

    @needs("_run_scene")
    def test_of_a_scene_leaves_a_checkpoint(self):
        with tempfile.TemporaryDirectory() as folder:
            self.interrupted(SCENE, folder)
            self.assertTrue(any("checkpoint" in name for name in os.listdir(folder)), os.listdir(folder))


if __name__ == "__main__":
    unittest.main()
