#!/usr/bin/env python3
"""Checks the order of the rooms, and that CMake knows every source file.

A room includes only itself and rooms before it in ROOMS: never sideways, never back up.
main.cc and launcher.cc, outside the rooms, may include anything. Usage: check_rooms.py PROJECT
"""

import re
import sys
from pathlib import Path

ROOMS = ("core material element mesh algebra scene space form solver march measure output "
         "run").split()
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<(isochor/[^>]+)>)')


def room_violations(project):
    """One line of text for each include that breaks the order."""
    found = []
    for base in (project / "include" / "isochor", project / "source"):
        for file in sorted([*base.rglob("*.h"), *base.rglob("*.cc")]):
            parts = file.relative_to(base).parts
            place = file.relative_to(project)
            if parts in (("main.cc",), ("launcher.cc",)):
                continue
            if parts[0] not in ROOMS:
                found.append(f"{place}: {parts[0]} is not a room; the rooms are {' '.join(ROOMS)}")
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                target = (match[1] or match[2]).split("/")
                if len(target) == 1 and (file.parent / target[0]).exists():
                    continue  # a header that one room keeps to itself
                if target[0] != "isochor" or len(target) < 3 or ".." in target:
                    reason = "write includes of our own as <isochor/ROOM/FILE.h>"
                elif target[1] not in ROOMS:
                    reason = f"{target[1]} is not a room"
                elif ROOMS.index(target[1]) > ROOMS.index(parts[0]):
                    reason = f"{parts[0]} comes before {target[1]} and must not know it"
                else:
                    continue
                found.append(f"{place}:{number}: {line.strip()}: {reason}")
    return found


def unlisted_sources(project):
    """One line of text for each .cc below source/ that source/CMakeLists.txt does not name."""
    source = project / "source"
    text = re.sub(r"#.*", "", (source / "CMakeLists.txt").read_text())
    listed = set(re.findall(r"[\w/.-]+\.cc", text))
    existing = {str(file.relative_to(source)) for file in source.rglob("*.cc")}
    return [f"source/{name}: not listed in source/CMakeLists.txt"
            for name in sorted(existing - listed)]


def main():
    project = Path(sys.argv[1] if len(sys.argv) > 1 else ".").absolute()
    found = room_violations(project) + unlisted_sources(project)
    print("\n".join(found) or "The rooms are in order.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
