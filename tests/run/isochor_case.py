"""What the tests of whole runs share: a folder, the program in it, and its results."""

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


# Status of a run that has reached the full load.
CONVERGED = "stable"


def read_csv(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


class IsochorCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"

    def start(self, text, *arguments, ranks=1, out=None, mpirun=()):
        """The running program."""
        (self.folder / "scene.prm").write_text(text)
        command = [*MPIRUN, *mpirun, "-np", str(ranks)] if ranks > 1 else []
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        process = subprocess.Popen(
            [*command, ISOCHOR, "scene.prm", "--output", out or self.out, *arguments],
            cwd=self.folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True)
        self.addCleanup(self.kill, process)
        return process

    def kill(self, process):
        """kill -9, of all ranks."""
        if process.poll() is None:
            children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
            for pid in [process.pid, *map(int, children)]:
                try:
                    os.kill(pid, signal.SIGKILL)
                except ProcessLookupError:
                    pass
            process.communicate()

    def finish(self, process, code):
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, code, out + err)
        return out + err

    def run_isochor(self, text, *arguments, code=0, **keywords):
        return self.finish(self.start(text, *arguments, **keywords), code)

    def wait_for(self, process, is_there):
        deadline = time.monotonic() + 120
        while not is_there():
            self.assertIsNone(process.poll(), "the run ended too early")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)

    def wait_for_steps(self, process, n, folder=None):
        """Until steps.csv has n rows."""
        steps = (folder or self.out) / "steps.csv"
        self.wait_for(process, lambda: steps.exists() and len(steps.read_text().splitlines()) > n)

    def check_files(self, status, folder=None):
        """One row with this status, and a series whose every state is there and can be read."""
        folder = folder or self.out
        rows = read_csv(folder / "results.csv")
        self.assertEqual([row["status"] for row in rows], [status])
        files = [entry.get("file") for entry in self.series(folder)]
        self.assertTrue(files)
        for name in files:
            if name.endswith(".pvtu"):
                xml.parse(folder / name)
            self.assertGreater((folder / name).stat().st_size, 0)
        steps = read_csv(folder / "steps.csv")
        self.assertEqual(len(steps), int(rows[0]["load steps"]))
        if steps:
            self.assertEqual(steps[-1]["load factor"], rows[0]["load factor"])
        return rows[0]

    def series(self, folder):
        return list(xml.parse(folder / "solution.pvd").getroot().iter("DataSet"))
