#!/usr/bin/python3
"""Picture of the pressures of this study's scene on 12 x 12 x 12 blocks by P1-P1 and P1-P1s, the paper's figure
15; writes pressure.png beside this file.

  make_picture.py [ISOCHOR]    default: build/release/isochor
"""

import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCRIPTS = HERE.parents[1] / "scripts"
sys.path.insert(0, str(SCRIPTS))

from benchmark_runs import ROOT, Failed, run  # noqa: E402

ELEMENTS = ["P1-P1", "P1-P1s"]


def main():
    program = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release" / "isochor")
    try:
        with tempfile.TemporaryDirectory() as folder:
            states = []
            for element in ELEMENTS:
                output = Path(folder) / element
                run(program.resolve(), HERE / "study.prm",
                    {"Method/Element": element, "Scene/Cells": "12, 12, 12",
                     "Study/Reference": "", "Output/VTU": "final"}, output=output)
                states.append(output / "solution.pvd")
            labels = [word for element in ELEMENTS for word in ("--label", element)]
            subprocess.run([SCRIPTS / "picture.py", "-o", HERE / "pressure.png", "--field",
                            "pressure", "--limits", "-30000", "30000",
                            *labels, *states], check=True)
    except (Failed, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"make_picture.py: error: {error}")


if __name__ == "__main__":
    main()
