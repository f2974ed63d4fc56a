"""scripts/benchmark_runs.py with a program that answers at once, or not at all."""

import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

import benchmark_runs  # noqa: E402

# A stand-in for isochor. With "Wait = 1" it runs until it is asked to end; exit code 2 as isochor.
PROGRAM = f"""#!{sys.executable}
import signal, sys, time
from pathlib import Path
status = "converged"
def stop(*_):
    global status
    status = "interrupted"
signal.signal(signal.SIGINT, stop)
output = Path(sys.argv[sys.argv.index("--output") + 1])
if "Method/Element=P9" in sys.argv:
    sys.exit("no such element")
while "Method/Wait=1" in sys.argv and status == "converged":
    time.sleep(0.01)
(output / "results.csv").write_text(
    "unknowns,seconds mesh,seconds total,status\\n768,0.5,2," + status + "\\n")
sys.exit(0 if status == "converged" else 2)
"""


class BenchmarkRuns(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.isochor = self.folder / "isochor"
        self.isochor.write_text(PROGRAM)
        self.isochor.chmod(0o755)

    def run_with(self, settings, limit=None):
        return benchmark_runs.run(self.isochor, self.folder / "scene.prm", settings, limit=limit)

    def test_seconds_leave_out_the_mesh(self):
        row = benchmark_runs.numbers(self.run_with({}))
        self.assertEqual((row["unknowns"], row["seconds"], row["status"]), (768, 1.5, "converged"))

    def test_a_run_over_the_limit_is_asked_to_end(self):
        self.assertEqual(self.run_with({"Method/Wait": 1}, limit=1)["status"], "interrupted")

    def test_bad_input_is_an_error_with_what_was_said(self):
        with self.assertRaisesRegex(benchmark_runs.Failed, "exit code 1(.|\n)*no such element"):
            self.run_with({"Method/Element": "P9"})

    def test_results_stay_where_they_are_wanted(self):
        kept = self.folder / "kept"
        kept.mkdir()
        benchmark_runs.run(self.isochor, self.folder / "scene.prm", {}, output=kept)
        self.assertTrue((kept / "results.csv").is_file())

    def test_all_is_run_before_anything_is_run_again(self):
        seconds = {("a", "x"): [3., 1., 2.], ("b", "x"): [9., 7., 8.]}
        order = []

        def measure(case, method):
            order.append(case)
            return {"seconds": seconds[case, method][order.count(case) - 1], "status": case,
                    "iterations": order.count(case)}

        found = benchmark_runs.interleaved(3, ["a", "b"], lambda case: ["x"], measure)
        self.assertEqual(order, ["a", "b"] * 3)
        self.assertEqual(found["a", "x"], {"seconds": 2., "status": "a", "iterations": 2})
        self.assertEqual(found["b", "x"]["seconds"], 8.)

    def test_tables_and_rows_are_written_in_place(self):
        readme = self.folder / "README.md"
        readme.write_text("# A\n<!-- begin: speed -->\nold\n<!-- end -->\nrest\n")
        rows, tables = [{"case": "beam", "seconds": 1.5}], {"speed": "new\n"}
        benchmark_runs.publish(self.folder, rows, tables, show=True)
        self.assertIn("old", readme.read_text())
        benchmark_runs.publish(self.folder, rows, tables, show=False)
        self.assertEqual(readme.read_text(),
                         "# A\n<!-- begin: speed -->\nnew\n<!-- end -->\nrest\n")
        self.assertEqual((self.folder / "baseline.csv").read_text(), "case,seconds\nbeam,1.5\n")


if __name__ == "__main__":
    unittest.main()
