"""What a user starts: finds the program from wherever it is called, and sets what libraries read. Kernels of
OpenBLAS: the processor's, though the library may not know it, unless the user chooses."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from isochor_case import ISOCHOR, MPIRUN


def kernels(command, **variables):
    """What OpenBLAS says of itself, or None if the BLAS is another."""
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_CORETYPE"}
    text = subprocess.run([*command, ISOCHOR, "--version"], env=dict(environment, **variables),
                          stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=True).stdout
    match = re.search(r"\(OpenBLAS ([^)]*)\)", text)
    return match and match[1]


class BlasKernels(unittest.TestCase):
    def setUp(self):
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            flags = re.search(r"^flags\s*:(.*)$", stream.read(), re.MULTILINE)
        if not flags or not {"avx2", "fma"} <= set(flags[1].split()):
            self.skipTest("the processor has no AVX2")
        if "DYNAMIC_ARCH" not in (kernels([]) or ""):
            self.skipTest("the BLAS is not OpenBLAS with kernels to choose from")

    def test_the_processors_own(self):
        for command in ([], [*MPIRUN, "-np", "1"]):
            with self.subTest(command=command):
                self.assertNotRegex(kernels(command), "Prescott|Core2|Nehalem|Barcelona")

    def test_the_users_choice(self):
        self.assertIn("Nehalem", kernels([], OPENBLAS_CORETYPE="Nehalem"))


class Place(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = Path(folder.name) / "isochor"

    def version(self):
        return subprocess.run([self.here, "--version"], capture_output=True, text=True)

    def test_a_link(self):
        self.here.symlink_to(Path(ISOCHOR).resolve())
        told = self.version()
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertTrue(told.stdout.startswith("Isochor"))

    def test_a_copy_alone(self):
        shutil.copy(ISOCHOR, self.here)
        told = self.version()
        self.assertEqual(told.returncode, 3)
        self.assertIn("libexec/isochor', which belongs beside this program", told.stderr)


if __name__ == "__main__":
    unittest.main()
