"""--restart: a run that was killed goes on from its last saved state and ends as if it had not been.
The reference is the same run without interruption."""

import re
import signal
import unittest

from isochor_case import CONVERGED, read_csv
from restart_case import COSTS, RestartCase

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

# At the full load at once, on a coarser mesh or on this one, Newton's method fails.
NO_COARSE_START = ["Method/Nested levels=1", "Method/Maximum Newton iterations=5",
                   "Scene/Traction=right: 0, -3000, 0"]
# Nothing is thrown away where every tangent is factored: all but these must be the same.
CLOCKS = re.compile("seconds|peak memory|folder")
DUAL_COSTS = re.compile(COSTS.pattern + "|dual")


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


class Restart(RestartCase):
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

    def test_counts(self):
        """Of the part before the interruption and the part after it."""
        direct = "Method/Linear solver=direct"
        for case, settings, status in (
                ("direct", [direct], CONVERGED),
                ("matrix-free", ["Method/Linear solver=CG"], "converged"),
                ("nested", [direct, *NO_COARSE_START], CONVERGED)):
            with self.subTest(case=case):
                arguments = [word for setting in settings for word in ("--set", setting)]
                whole, self.out = self.folder / f"{case} whole", self.folder / case
                told_whole = self.run_isochor(ONE, *arguments, out=whole)
                wanted = self.check_files(status, whole)
                self.kill_after(ONE, 5, *arguments)
                told = self.run_isochor(ONE, "--restart", *arguments)
                self.assert_same(self.check_files(status), wanted, CLOCKS)
                for row, other in zip(read_csv(self.out / "steps.csv"),
                                      read_csv(whole / "steps.csv"), strict=True):
                    self.assert_same(row, other, CLOCKS)
                if case == "nested":
                    self.assertGreater(int(wanted["coarse newton iterations"]), 0)
                    self.assertGreater(int(wanted["failed steps"]), 0)
                    for words in (told_whole, told):
                        self.assertIn("nested iteration: the interpolated state led to no", words)

    def test_dual_ascent(self):
        # Large steps first: most iterations are before the interruption.
        text = ONE.replace("Traction        = right: 0, -300, 0", "Prescribed displacement = "
                           "right: -, 0.1*(1 - (1 - load)^4), -")
        dual = ("--set", "Method/Solver=dual ascent")
        self.run_isochor(text, *dual, out=self.folder / "whole")
        wanted = self.check_files(CONVERGED, self.folder / "whole")
        self.kill_after(text, 5, *dual)
        self.run_isochor(text, "--restart", *dual)
        found, steps = self.check_files(CONVERGED), read_csv(self.out / "steps.csv")
        self.assert_same(found, wanted, DUAL_COSTS)
        for name in ("dual iterations", "dual iterations to 1 %", "dual iterations to 0.01 %"):
            counts = [int(step[name]) for step in steps]
            self.assertEqual(int(found[name]), max(counts), name)
            if name != "dual iterations to 1 %": # 1 in all steps
                self.assertGreater(max(counts[:5]), max(counts[6:]), name)
        self.assertEqual(int(found["newton iterations"]),
                         sum(int(step["newton iterations"]) for step in steps))

    def test_other_version(self):
        self.kill_after(ONE, 3)
        for file in self.checkpoints():
            line, rest = file.read_bytes().split(b"\n", 1)
            self.assertRegex(line, rb"^Isochor checkpoint \d+$")
            file.write_bytes(b"Isochor checkpoint 1\n" + rest)
        before = contents(self.out)
        told = self.run_isochor(ONE, "--restart", code=1)
        self.assertRegex(told, "was saved by another version of Isochor, as 'Isochor checkpoint 1';"
                               rf" allowed: '{line.decode()}', or .* --overwrite")
        self.assertEqual(contents(self.out), before)

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
        # The last of the pieces may be one that was not finished.
        names = {file.name for file in self.checkpoints()}
        of_rank_1 = max(name for name in names if name.endswith(".1") and name[:-1] + "0" in names)
        (self.out / of_rank_1).unlink()
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
