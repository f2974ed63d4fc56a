"""Does check_rooms.py see what it is there to see? Violations planted in a made-up project."""

import tempfile
import unittest
from pathlib import Path

from check_rooms import room_violations, unlisted_sources


class CheckRooms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.project = Path(folder.name)
        self.write("source/CMakeLists.txt", "set(SOURCES\n  form/gravity.cc main.cc)\n# x/y.cc\n")

    def write(self, name, text):
        file = self.project / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def violations(self):
        return room_violations(self.project)

    def test_downwards_and_own_room_are_allowed(self):
        self.write("include/isochor/form/form.h",
                   "#include <isochor/core/error.h>\n#include <isochor/form/load.h>\n"
                   "#include <deal.II/base/point.h>\n#include <vector>\n")
        self.assertEqual(self.violations(), [])

    def test_upwards_is_named_with_file_and_line(self):
        self.write("source/form/gravity.cc", "// one\n  #  include <isochor/solver/newton.h>\n")
        self.assertEqual(len(self.violations()), 1)
        self.assertIn("source/form/gravity.cc:2:", self.violations()[0])

    def test_headers_are_searched_too(self):
        self.write("include/isochor/core/error.h", '#include "isochor/run/run.h"\n')
        self.assertEqual(len(self.violations()), 1)

    def test_relative_includes_and_unknown_rooms(self):
        self.write("source/form/a.cc", '#include "../solver/newton.h"\n')
        self.write("source/form/b.cc", "#include <isochor/attic/box.h>\n")
        self.write("source/attic/c.cc", "")
        self.assertEqual(len(self.violations()), 3)

    def test_a_header_beside_the_source_is_allowed(self):
        self.write("source/form/parts.h", "")
        self.write("source/form/a.cc", '#include "parts.h"\n')
        self.assertEqual(self.violations(), [])

    def test_main_may_include_anything(self):
        self.write("source/main.cc", "#include <isochor/run/run.h>\n")
        self.assertEqual(self.violations(), [])

    def test_sources_that_cmake_does_not_know(self):
        self.write("source/form/gravity.cc", "")
        self.write("source/x/y.cc", "")
        self.assertEqual(len(unlisted_sources(self.project)), 1)
        self.assertIn("x/y.cc", unlisted_sources(self.project)[0])


if __name__ == "__main__":
    unittest.main()
