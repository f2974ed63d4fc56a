"""Runs that end before the full load: exit code 2, the reason, and valid files on disk."""

import signal
import unittest

from isochor_case import CONVERGED, IsochorCase, read_csv

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
SLOW = SCENE.format(cells="24, 4, 4", traction="0, -100, 0", steps=50000)  # minutes


class Endings(IsochorCase):
    def test_load_far_too_big(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                text = SCENE.format(cells="6, 1, 1", traction="-1e9, 0, 0", steps=1)
                told = self.run_isochor(text, "--overwrite", ranks=ranks, code=2)
                self.assertRegex(told, "not converged: (inverted cell|unstable|singular tangent|no con)")
                row = self.check_files("not converged")
                self.assertIn("step below minimum", row["reason"])
                self.assertEqual(row["tip [m]"], "")
                # What is left is the state at rest.
                self.assertEqual((row["load steps"], float(row["min J"])), ("0", 1))
                self.assertEqual(float(row["volume ratio"]), 1)

    def test_initial_state_is_left(self):
        text = SCENE.format(cells="6, 1, 1", traction="-1e9, 0, 0", steps=1).replace(
            "set Fixed  ", "set Initial displacement = -0.25*x, 0, 0\n set Fixed  ")
        self.run_isochor(text, code=2)
        row = self.check_files("not converged")
        self.assertEqual(row["load steps"], "0")
        self.assertAlmostEqual(float(row["min J"]), 0.75)

    def test_refused_run_has_no_state(self):
        # Dual ascent needs pressures.
        text = SCENE.format(cells="6, 1, 1", traction="0, -1, 0", steps=1) + (
            "subsection Method\n set Element = {{P1|P1-P1}}\n set Solver = dual ascent\nend\n")
        self.run_isochor(text, code=2)
        refused, solved = read_csv(self.out / "results.csv")
        self.assertEqual((refused["status"], solved["status"]), ("refused", CONVERGED))
        self.assertEqual((refused["min J"], refused["volume ratio"]), ("", ""))
        self.assertGreater(float(solved["min J"]), 0.9)

    def interrupt(self, ranks, code, **keywords):
        process = self.start(SLOW, ranks=ranks, **keywords)
        self.wait_for_steps(process, 3)
        process.send_signal(signal.SIGINT)
        told = self.finish(process, code)
        row = self.check_files("interrupted")
        self.assertIn("interrupted", told)
        self.assertRegex(row["reason"], "^interrupted (after|on the way to) load factor")
        self.assertLess(float(row["load factor"]), 1)

    def test_interrupt(self):
        self.interrupt(ranks=1, code=2)

    def test_interrupt_of_mpirun(self):
        # mpirun passes the signal on after this time (s), and waits as long again before it kills; the
        # second that it waits unless told is too little on a busy machine. The code is its own.
        self.interrupt(ranks=2, code=1, mpirun=("--mca", "odls_base_sigkill_timeout", "20"))

    def test_bad_input_keeps_old_results(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.run_isochor(text)
        before = {path.name: path.read_bytes() for path in self.out.iterdir()}
        told = self.run_isochor(text, "--overwrite", "--set", "Scene/Fixed=links", code=1)
        self.assertIn("no boundary is named 'links'", told)
        self.assertEqual({path.name: path.read_bytes() for path in self.out.iterdir()}, before)

    def test_overwrite_keeps_what_is_not_ours(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.run_isochor(text)
        (self.out / "notes.txt").write_text("mine")
        self.run_isochor(text, "--overwrite")
        self.assertEqual((self.out / "notes.txt").read_text(), "mine")
        self.check_files(CONVERGED)

    def test_bad_input_makes_no_folder(self):
        text = SCENE.format(cells="2, 1, 1", traction="0, -1, 0", steps=1)
        self.run_isochor(text.replace("left", "links"), code=1)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
