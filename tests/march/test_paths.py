"""Paths with limit points against exact and beam solutions; what load control does about them."""

import cmath
import csv
import math
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

ISOCHOR = os.environ["ISOCHOR"]
MPIRUN = [os.environ.get("MPIRUN", "mpirun"), "-q", "--oversubscribe", "--bind-to", "none"]
if os.geteuid() == 0:
    MPIRUN.append("--allow-run-as-root")
EXAMPLES = Path(__file__).resolve().parents[2] / "prm"


def balloon_pressure(stretch, inner=1., outer=1.2, mu=1e5):
    """Of an incompressible neo-Hookean shell whose inner radius has grown by STRETCH."""
    def g(x):
        return 1 / x + 1 / (4 * x**4)
    outside = (1 + (stretch**3 - 1) * (inner / outer)**3)**(1 / 3)
    return 2 * mu * (g(outside) - g(stretch))


def frame_force(d, length=1., rise=0.05, thickness=0.02, modulus=1e6 / (1 - 0.3**2)):
    """Downward force on the end of a shallow inclined beam that is clamped at its foot and guided
    vertically at its end, which has moved down by D. With the compression P the deflection -d g(x)
    solves EI g'''' + P g'' = 0, and P solves int (g' d)^2 / 2 - rise d / length + P length / EA = 0,
    that the ends keep their distance."""
    EI, EA = modulus * thickness**3 / 12, modulus * thickness

    def shape(P):
        # g = a (1 - cos kx) + b (kx - sin kx), g(length) = 1, g'(length) = 0
        k = cmath.sqrt(complex(P / EI)) if abs(P) > 1e-6 * EI else complex(1e-3)
        sin, cos = cmath.sin(k * length), cmath.cos(k * length)
        determinant = sin * (k * length - sin) - (1 - cos)**2
        a, b = -(1 - cos) / determinant, sin / determinant
        n = 200
        slope2 = [(a * k * cmath.sin(k * x) + b * k * (1 - cmath.cos(k * x)))**2
                  for x in (length * i / n for i in range(n + 1))]
        simpson = sum(slope2[i] * (4 if i % 2 else 2) for i in range(1, n)) * length / (3 * n)
        return simpson.real, (k**3 * (b * cos - a * sin)).real

    low, high = -2 * rise**2 * EA, (2 * math.pi / length)**2 * EI * (1 - 1e-9)
    for _ in range(60):
        P = (low + high) / 2
        if shape(P)[0] * d * d / 2 - rise * d / length + P * length / EA > 0:
            high = P
        else:
            low = P
    return -EI * d * shape(P)[1] + P * rise / length


class Paths(unittest.TestCase):
    def follow(self, file, *settings, ranks=1, code=0):
        """The result's row, and the steps."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        command = [*MPIRUN, "-np", str(ranks)] if ranks > 1 else []
        command += [ISOCHOR, str(EXAMPLES / file), "--output", f"{folder.name}/out"]
        for setting in ("Output/VTU=none", *settings):
            command += ["--set", setting]
        environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        tables = []
        for name in ("results.csv", "steps.csv"):
            with open(f"{folder.name}/out/{name}", newline="") as stream:
                tables.append(list(csv.DictReader(stream)))
        return tables[0][0], tables[1]

    def check_modes(self, steps, positions, turns):
        """Modes too many: none, one between the TURNS, steps next to them aside."""
        for step, position in zip(steps, positions):
            if min(abs(position - turn) for turn in turns) > 0.05 * turns[0]:
                expected = sum(position > turn for turn in turns) % 2
                self.assertEqual(int(step["negative pivots excess"]), expected, step)

    def test_balloon(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                # Steps so short that one comes near the limit.
                result, steps = self.follow("balloon.prm", "Scene/Cells=1,2",
                                            "Method/Target Newton iterations=4", ranks=ranks)
                self.assertEqual(result["status"], "unstable (1 mode)")
                stretches = [1 + float(step["inner [m]"]) for step in steps]
                self.assertGreaterEqual(stretches[-1], 3)
                for step, stretch in zip(steps, stretches):
                    exact = balloon_pressure(stretch)
                    self.assertAlmostEqual(30e3 * float(step["load factor"]) / exact, 1, delta=0.01)
                self.check_modes(steps, [stretch - 1 for stretch in stretches], [0.470])
                greatest = max(float(step["load factor"]) for step in steps)
                self.assertAlmostEqual(30e3 * greatest / 22513.8, 1, delta=0.01)

    def test_snap_through(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                result, steps = self.follow("snap_through.prm", ranks=ranks)
                self.assertEqual(result["status"], "stable")
                self.assertEqual(float(result["load factor"]), 1)
                middle = [-float(step["middle [m]"]) for step in steps]
                for step, d in zip(steps, middle):
                    # 50 Pa on 0.02 m; shear and the slope of 1:20 are left out of beam theory.
                    self.assertAlmostEqual(float(step["load factor"]), frame_force(d), delta=0.015)
                self.check_modes(steps, middle, [0.0205, 0.0585])

    def test_load_control_snaps_to_the_same_state(self):
        along = self.follow("snap_through.prm")[0]
        jumped = self.follow("snap_through.prm", "Method/Stepping=fixed")[0]
        self.assertEqual(jumped["status"], "stable")
        self.assertAlmostEqual(float(jumped["middle [m]"]), float(along["middle [m]"]), delta=1e-7)

    def test_limit_under_load_control(self):
        result, steps = self.follow("balloon.prm", "Scene/Cells=1,2", "Method/Stepping=adaptive",
                                    code=2)
        self.assertEqual(result["status"], "not converged")
        self.assertRegex(result["reason"], "step below minimum")
        self.assertAlmostEqual(30e3 * float(steps[-1]["load factor"]) / 22513.8, 1, delta=0.01)
        self.check_limit(result, 22513.8 / 30e3, 0.005)

    def check_limit(self, result, load, delta):
        said = re.search(r"limit point near load factor ([0-9.]+),.* arc length", result["reason"])
        self.assertTrue(said, result["reason"])
        self.assertAlmostEqual(float(said[1]), load, delta=delta)

    def test_limit_without_the_filter(self):
        greatest = max(frame_force(0.0205 + 1e-4 * k) for k in range(-10, 11))
        # Larger fixed steps would jump over it.
        for stepping, n in (("fixed", 20), ("adaptive", 10)):
            with self.subTest(stepping=stepping):
                result, _ = self.follow("snap_through.prm", f"Method/Stepping={stepping}",
                                        f"Method/Load steps={n}", "Method/Curvature filter=none",
                                        code=2)
                self.check_limit(result, greatest, 0.015)

    def test_loads_that_are_not_affine(self):
        # The loads of the other tests at another load factor: its square, or half of it and half of
        # its square.
        for form, load in (("load", lambda l: l * l), ("(1 + load)/2", lambda l: l * (1 + l) / 2)):
            with self.subTest(form=form):
                result, steps = self.follow("snap_through.prm",
                                            f"Scene/Traction=right: 0, -50*{form}")
                self.assertEqual(float(result["load factor"]), 1)
                for step in steps:
                    self.assertAlmostEqual(load(float(step["load factor"])),
                                           frame_force(-float(step["middle [m]"])), delta=0.015)

                result, steps = self.follow("balloon.prm", "Scene/Cells=1,2",
                                            f"Scene/Pressure=inner: 30e3*{form}")
                self.assertEqual(result["status"], "unstable (1 mode)")
                for step in steps:
                    exact = balloon_pressure(1 + float(step["inner [m]"]))
                    self.assertAlmostEqual(30e3 * load(float(step["load factor"])) / exact, 1,
                                           delta=0.01)

                # The middle is moved; the force that this takes has the limit points.
                result, steps = self.follow(
                    "snap_through.prm", "Scene/Traction=", "Scene/Fixed components=",
                    f"Scene/Prescribed displacement=right: 0, -0.1*load*{form}",
                    "Scene/Probes=middle: mean displacement y on right; force: reaction on right")
                self.assertEqual(float(result["load factor"]), 1)
                for step in steps:
                    d = 0.1 * load(float(step["load factor"]))
                    self.assertAlmostEqual(-float(step["middle [m]"]), d, delta=1e-9)
                    self.assertAlmostEqual(-float(step["force y [N/m]"]), frame_force(d),
                                           delta=0.015)

    def test_path_that_does_not_end(self):
        result, steps = self.follow("balloon.prm", "Scene/Cells=1,2", "Method/Path steps=3", code=2)
        self.assertEqual(len(steps), 3)
        self.assertRegex(result["reason"], "^the path has not ended after 3 steps")


if __name__ == "__main__":
    unittest.main()
