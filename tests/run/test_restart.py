"""--restart: a run that was killed goes on from its last saved state and ends as if it had not been.
The reference is the same run without interruption."""

import re
import signal
import unittest

from isochor_case import CONVERGED, IsochorCase, read_csv

SCENE = """
subsection Scene
  set Mesh            = box(1, 0.1, 0.1)
  set Cells           = 8, 1, 1
  set Young's modulus = 266e3
  set Poisson ratio   = {poisson_ratio}
  set Fixed           = left
  set Traction        = right: 0, -300, 0
  set Probes          = tip: mean displacement on right; volume: volume
end
subsection Method
  set Load steps       = {steps}
  set Newton tolerance = 1e-10
end
"""
ONE = SCENE.format(poisson_ratio=0.49, steps=20)
STUDY = SCENE.format(poisson_ratio="{{0.3|0.45|0.49}}", steps=20)

# What two runs of one program may spend differently, and what an interruption throws away: the
# stress predicted for the next tangent and the kept factors.
COSTS = re.compile("seconds|memory|factorisations|krylov|newton|folder")
# Newton stops at 1e-10 of the forces; what is left is compared to a few digits less.
DIGITS = 1e-7


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


class Restart(IsochorCase):
    def assert_same(self, row, wanted):
        self.assertEqual(list(row), list(wanted))
        for name in wanted:
            if COSTS.search(name):
                continue
            with self.subTest(column=name):
                try:
                    self.assertAlmostEqual(float(row[name]), float(wanted[name]),
                                           delta=DIGITS * max(abs(float(wanted[name])), 1e-3))
                except ValueError:
                    self.assertEqual(row[name], wanted[name])

    def kill_after(self, text, n_steps, *arguments, folder=None, **keywords):
        process = self.start(text, *arguments, **keywords)
        self.wait_for_steps(process, n_steps, folder)
        self.kill(process)

    def checkpoints(self, folder=None):
        return sorted((folder or self.out).glob("checkpoint_*"))

    def test_killed(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                whole = self.folder / f"whole_{ranks}"
                self.run_isochor(ONE, out=whole, ranks=ranks)
                wanted = self.check_files(CONVERGED, whole)
                self.assertEqual(self.checkpoints(whole), [])

                self.out = self.folder / f"killed_{ranks}"
                self.kill_after(ONE, 4, ranks=ranks)
                self.assertFalse(read_csv(self.out / "results.csv"))
                self.assertGreaterEqual(len(self.checkpoints()), 2 * ranks)
                told = self.run_isochor(ONE, "--restart", ranks=ranks)
                self.assertRegex(told, r"continued from the state saved after load step \d+")
                self.assert_same(self.check_files(CONVERGED), wanted)
                # Neither a row or picture twice nor one too few.
                for row, other in zip(read_csv(self.out / "steps.csv"),
                                      read_csv(whole / "steps.csv"), strict=True):
                    self.assertEqual(row["step"], other["step"])
                    self.assertEqual(row["load factor"], other["load factor"])
                    self.assertAlmostEqual(float(row["tip y [m]"]), float(other["tip y [m]"]), 8)
                self.assertEqual([(entry.get("timestep"), entry.get("file"))
                                  for entry in self.series(self.out)],
                                 [(entry.get("timestep"), entry.get("file"))
                                  for entry in self.series(whole)])
                self.assertEqual(self.checkpoints(), [])

    def test_interrupted_twice(self):
        self.run_isochor(ONE, out=self.folder / "whole")
        process = self.start(ONE)
        self.wait_for_steps(process, 3)
        process.send_signal(signal.SIGINT)
        self.finish(process, 2)
        steps = len(read_csv(self.out / "steps.csv"))
        self.kill_after(ONE, steps + 3, "--restart")
        self.run_isochor(ONE, "--restart")
        self.assert_same(self.check_files(CONVERGED), self.check_files(
            CONVERGED, self.folder / "whole"))

    def test_damaged(self):
        self.run_isochor(ONE, out=self.folder / "whole")
        self.kill_after(ONE, 6)
        older, newer = self.checkpoints()
        newer.write_bytes(newer.read_bytes()[:-100])
        number = int(older.name.split("_")[1].split(".")[0])
        told = self.run_isochor(ONE, "--restart")
        self.assertIn(f"the state saved after load step {number + 1} is damaged", told)
        self.assertIn(f"continued from the state saved after load step {number},", told)
        self.assert_same(self.check_files(CONVERGED), self.check_files(
            CONVERGED, self.folder / "whole"))

    def test_one_rank_missing(self):
        self.kill_after(ONE, 6, ranks=2)
        checkpoints = self.checkpoints()
        checkpoints[-1].unlink()
        told = self.run_isochor(ONE, "--restart", ranks=2)
        self.assertIn("is damaged or not whole", told)
        self.check_files(CONVERGED)

    def test_refused(self):
        told = self.run_isochor(ONE, "--restart", code=1)
        self.assertIn("holds no results of Isochor", told)
        self.kill_after(ONE, 3)
        before = contents(self.out)
        for change, said in (("Scene/Poisson ratio=0.3", "Scene/Poisson ratio was '0.49', is '0.3'"),
                             ("Scene/Cells=8, 1, 2", "Scene/Cells was '8, 1, 1', is '8, 1, 2'"),
                             ("Method/Element=P2-P1", "Method/Element was 'P1-P1', is 'P2-P1'")):
            told = self.run_isochor(ONE, "--restart", "--set", change, code=1)
            self.assertIn("belong to another run: " + said, told)
            self.assertEqual(contents(self.out), before)
        told = self.run_isochor(ONE, "--restart", ranks=2, code=1)
        self.assertIn("number of ranks was '1', is '2'", told)
        self.assertEqual(contents(self.out), before)
        # How it is solved may change.
        self.run_isochor(ONE, "--restart", "--set", "Method/Linear solver=direct", "--set",
                         "Method/Load steps=5")
        self.check_files(CONVERGED)

    def test_nothing_saved(self):
        self.kill_after(ONE, 3, "--set", "Output/Checkpoint=never")
        self.assertIn("no state is saved in", self.run_isochor(ONE, "--restart", code=1))
        self.out = self.folder / "slow"
        self.kill_after(ONE, 3, "--set", "Output/Checkpoint=1000")
        self.assertIn("no state is saved in", self.run_isochor(ONE, "--restart", code=1))

    def test_finished(self):
        text = SCENE.format(poisson_ratio=0.49, steps=1)
        self.run_isochor(text)
        self.assertRegex(self.run_isochor(text, "--restart"),
                         "the run in '.*out' is finished: converged")

    def test_study(self):
        whole = self.folder / "whole"
        self.run_isochor(STUDY, out=whole)
        self.kill_after(STUDY, 3, folder=self.out / "run_002")
        first = self.out / "run_001" / "steps.csv"
        before = first.stat().st_mtime_ns
        rows = read_csv(self.out / "results.csv")
        self.assertEqual(len(rows), 1)
        told = self.run_isochor(STUDY, "--restart")
        self.assertRegex(told, r"Poisson ratio 0\.45: continued from the state")
        self.assertEqual(first.stat().st_mtime_ns, before)
        found = read_csv(self.out / "results.csv")
        self.assertEqual(found[:1], rows)
        for row, wanted in zip(found, read_csv(whole / "results.csv"), strict=True):
            self.assert_same(row, wanted)

        told = self.run_isochor(STUDY, "--restart")
        self.assertIn("all runs were finished already", told)
        self.assertEqual(read_csv(self.out / "results.csv"), found)
        told = self.run_isochor(STUDY, "--restart", "--set", "Scene/Fixed=right", code=1)
        self.assertIn("holds another study: Scene/Fixed was 'left', is 'right'", told)


if __name__ == "__main__":
    unittest.main()
