"""Runs that end before the full load: exit code 2, the reason, and valid files on disk."""

import csv
import os
import signal
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

ISOCHOR = os.environ["ISOCHOR"]
MPIRUN = [os.environ.get("MPIRUN", "mpirun"), "-q", "--oversubscribe", "--bind-to", "none"]
if os.geteuid() == 0:
    MPIRUN.append("--allow-run-as-root")

SCENE = """
subsection Scene
  set Mesh            = box(1, 0.1, 0.1)
  set Cells           = {cells}
  set Young's modulus = 266e3
  set Poisson ratio   = 0.45
  set Fixed           = left
  set Traction        = right: {traction}
  set Probes          = tip: mean displacement y on right
end
subsection Method
  set Load steps        = {steps}
  set Minimum load step = 0.01
end
"""
SLOW = SCENE.format(cells="24, 4, 4", traction="0, -100, 0", steps=2000)


class Endings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"

    def start(self, text, *arguments, ranks=1):
        (self.folder / "scene.prm").write_text(text)
        command = [*MPIRUN, "-np", str(ranks)] if ranks > 1 else []
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        process = subprocess.Popen(
            [*command, ISOCHOR, "scene.prm", "--output", "out", *arguments], cwd=self.folder,
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        return process

    def finish(self, process, code):
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, code, out + err)
        return out + err

    def check_files(self, status):
        """One row with this status, and a series whose every state is there and can be read."""
        with open(self.out / "results.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([row["status"] for row in rows], [status])
        series = xml.parse(self.out / "solution.pvd").getroot()
        files = [entry.get("file") for entry in series.iter("DataSet")]
        self.assertTrue(files)
        for name in files:
            if name.endswith(".pvtu"):
                xml.parse(self.out / name)
            self.assertGreater((self.out / name).stat().st_size, 0)
        with open(self.out / "steps.csv", newline="") as stream:
            steps = list(csv.DictReader(stream))
        self.assertEqual(len(steps), int(rows[0]["load steps"]))
        if steps:
            self.assertEqual(steps[-1]["load factor"], rows[0]["load factor"])
        return rows[0]

    def test_load_far_too_big(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                text = SCENE.format(cells="6, 1, 1", traction="-1e9, 0, 0", steps=1)
                told = self.finish(self.start(text, "--overwrite", ranks=ranks), 2)
                self.assertIn("not converged: step below minimum: from load factor", told)
                row = self.check_files("not converged")
                self.assertIn("step below minimum", row["reason"])
                self.assertEqual(row["tip [m]"], "")

    def interrupt(self, ranks, code):
        process = self.start(SLOW, ranks=ranks)
        deadline = time.monotonic() + 120
        steps = self.out / "steps.csv"
        while not steps.exists() or len(steps.read_text().splitlines()) < 4:
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        told = self.finish(process, code)
        row = self.check_files("interrupted")
        self.assertIn("interrupted", told)
        self.assertRegex(row["reason"], "^interrupted (after|on the way to) load factor")
        self.assertLess(float(row["load factor"]), 1)

    def test_interrupt(self):
        self.interrupt(ranks=1, code=2)

    def test_interrupt_of_mpirun(self):
        self.interrupt(ranks=2, code=1)  # mpirun's own code; it passes the signal on

    def test_bad_input_keeps_old_results(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.finish(self.start(text), 0)
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        told = self.finish(self.start(text, "--overwrite", "--set", "Scene/Fixed=links"), 1)
        self.assertIn("no boundary is named 'links'", told)
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir()}, before)

    def test_overwrite_keeps_what_is_not_ours(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.finish(self.start(text), 0)
        (self.out / "notes.txt").write_text("mine")
        self.finish(self.start(text, "--overwrite"), 0)
        self.assertEqual((self.out / "notes.txt").read_text(), "mine")
        self.check_files("converged")

    def test_bad_input_makes_no_folder(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.finish(self.start(text.replace("left", "links")), 1)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
