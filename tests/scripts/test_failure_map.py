"""scripts/failure_map.py and failures.py on tables made by hand: what differs between loads, the word for
a failure, how far a method came, what the map shows, what a wrong table is told."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from failures import Loads, failures_rows, outcome  # noqa: E402
from results_table import Study  # noqa: E402

COSTS = ["cells", "unknowns", "load factor", "seconds total", "peak memory MB", "volume ratio",
         "min J", "status", "reason", "role"]
HEADER = ["Scene/Poisson ratio", "Scene/Pressure", "Method/Element", *COSTS]
STEP = "; step below minimum: from load factor 0.3 a step of 0.1 failed"
LIMIT = "; the displacements grow ever faster towards a limit point near load factor 0.31, beyond"
ENDS = {"stable": ("stable", "", 1), "converged": ("converged", "", 1),
        "two modes": ("unstable (2 modes)", "", 1), "one mode": ("unstable (1 mode)", "", 1),
        "inverted": ("not converged", "inverted cell (min J -0.1): no" + STEP, 0.3),
        "singular": ("not converged", "singular tangent (3 null pivots): no" + STEP, 0.3),
        "pivots": ("not converged", "unstable (1 negative pivots too many on the way): no" + STEP,
                   0.3),
        "limit": ("not converged", "unstable (1 negative pivots too many on the way): no" + STEP
                  + LIMIT, 0.3),
        "slow": ("not converged", "no convergence: no convergence in 25" + STEP, 0.3),
        "refused": ("refused", "P1 has no pressure", "")}


def row(nu, load, element, end="stable"):
    status, reason, reached = ENDS[end]
    least_j = 0.04 if (nu, load) == ("0.5", "inner: 3e3") else 0.9
    return [nu, load, element, 10, 100, reached, 1.5, 90, 1, least_j, status, reason, "run"]


def pressures(*ends, nu="0.49", element="P1"):
    """Runs that end so under 1000, 2000, 3000 Pa."""
    return [row(nu, f"inner: {i}e3", element, end) for i, end in enumerate(ends, 1)]


class FailureMap(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "baseline_tube.csv"

    def write(self, table, load="Pressure"):
        header = [name.replace("Pressure", load) for name in HEADER]
        with open(self.file, "w", newline="") as stream:
            csv.writer(stream).writerows([header, *table])
        return Study(self.file)

    def loads(self, load, *texts):
        return Loads(self.write([row(nu, text, "P1") for text in texts for nu in ("0.4", "0.5")],
                                load))

    def test_what_differs_between_loads(self):
        loads = self.loads("Gravity", "0, -9.8, 0", "0, -19.6, 0", "0, -0.98, 0")
        self.assertEqual(list(loads.amounts.values()), [-0.98, -9.8, -19.6])
        self.assertEqual(loads.label, "Gravity (0, …, 0) [m/s²]")
        loads = self.loads("Pressure", "inner: 4e3", "inner: 10e3")
        self.assertEqual(loads.amounts, {"inner: 4e3": 4000, "inner: 10e3": 10000})
        self.assertEqual(loads.label, "Pressure (inner) [Pa]")
        loads = self.loads("Prescribed rotation", "top: 90 about 0, 1, 0 axis 0, 1, 0",
                           "top: 180 about 0, 1, 0 axis 0, 1, 0")
        self.assertEqual(list(loads.amounts.values()), [90, 180])
        self.assertEqual(loads.label, "Prescribed rotation (top: … about 0, 1, 0 axis 0, 1, 0) [°]")
        loads = self.loads("Prescribed displacement", "r: 0.12*load, 0, 0", "r: 0.1*load, 0, 0")
        self.assertEqual(list(loads.amounts.values()), [0.1, 0.12])
        self.assertEqual(loads.label, "Prescribed displacement (r: …, 0, 0) [m]")

    def test_word_for_a_failure(self):
        words = {"stable": "", "converged": "", "two modes": "unstable, 2 modes",
                 "one mode": "unstable, 1 mode", "inverted": "inverted", "singular": "singular",
                 "pivots": "turns unstable, 1 mode", "limit": "limit point", "slow": "no convergence",
                 "refused": "refused"}
        self.assertEqual(set(words), set(ENDS))
        for end, word in words.items():
            study = self.write([row("0.49", "inner: 4e3", "P1", end),
                                row("0.5", "inner: 2e3", "P1")])
            found = outcome(study.runs[0], Loads(study))
            self.assertEqual(found.word, word)
            self.assertAlmostEqual(found.reached, 4000 * (ENDS[end][2] or 0))

    def summary(self, *ends):
        study = self.write(pressures(*ends) + pressures("stable", nu="0.5"))
        header, [line] = failures_rows(study)
        self.assertEqual(header, ["Pressure (inner) [Pa]", "ν = 0.49", "ν = 0.5"])
        self.assertEqual(line[0::2], ["P1", "1000"])
        return line[1]

    def test_how_far_a_method_came(self):
        self.assertEqual(self.summary("stable", "stable", "converged"), "3000")
        self.assertEqual(self.summary("inverted", "inverted", "limit"),
                         "300 inverted; 900 in larger steps")
        self.assertEqual(self.summary("stable", "inverted", "limit"),
                         "1000; 600 inverted on the way to 2000")
        self.assertEqual(self.summary("stable", "two modes", "slow"), "2000 unstable, 2 modes")
        self.assertEqual(self.summary("refused", "refused", "refused"), "refused")
        self.assertEqual(self.summary("stable", "slow", "stable"),
                         "1000; 600 no convergence on the way to 2000; but stable at 3000")

    def run_script(self):
        return subprocess.run([SCRIPTS / "failure_map.py", self.file], capture_output=True,
                              text=True)

    def test_map(self):
        self.write(pressures("stable", "two modes", "limit")
                   + pressures("stable", "stable", "stable", nu="0.5")
                   + pressures("refused", "refused", "refused", nu="0.5", element="P2"))
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("| P2 | - | refused |", result.stdout)
        svg = (self.folder / "tube_failure_map.svg").read_text()
        self.assertEqual(svg.count("min J 0.04"), 1)
        for text in ("Tube: loads that each method bears", "1.5 s", "limit point", "at 30 %",
                     "unstable,", "2 modes", "refused", "Pressure (inner) [Pa]", "not converged"):
            self.assertIn(f"<!-- {text} -->", svg.replace("\n", " -->\n<!-- "), text)
        self.assertGreater((self.folder / "tube_failure_map.png").stat().st_size, 10000)

    def test_nothing_stable(self):
        self.write(pressures("limit", "limit") + pressures("slow", "slow", nu="0.5"))
        result = self.run_script()
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def refused(self, *words):
        result = self.run_script()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in ("baseline_tube.csv", *words):
            self.assertIn(word, result.stderr)

    def test_bad_input(self):
        self.write(pressures("stable", "stable"))
        self.refused("varies Poisson ratio and one load", "Scene/Pressure")
        self.write([row(nu, load, "P1") for nu in ("0.4", "0.5") for load in ("in: 4", "out: 4")])
        self.refused("do not differ in a number", "'in: 4'")
        self.file.unlink()
        self.refused("No such file")


if __name__ == "__main__":
    unittest.main()
