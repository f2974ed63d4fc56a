"""What the tests of --restart share: runs that are killed, and how their ends are compared with those of
runs that are not."""

import re

from isochor_case import IsochorCase

# What two runs of one program may spend differently, and what an interruption throws away: the
# stress predicted for the next tangent and the kept factors.
COSTS = re.compile("seconds|memory|factorisations|krylov|newton|folder")
# Newton stops at 1e-10 of the forces; what is left is compared to a few digits less.
DIGITS = 1e-7


class RestartCase(IsochorCase):
    def assert_same(self, row, wanted, but=COSTS):
        self.assertEqual(list(row), list(wanted))
        for name in wanted:
            if but.search(name):
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
        """But for one that was being written."""
        return sorted(file for file in (folder or self.out).glob("checkpoint_*")
                      if file.suffix[1:].isdigit())
