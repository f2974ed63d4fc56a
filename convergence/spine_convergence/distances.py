#!/usr/bin/python3
"""How far the deformed surfaces of the finest runs are from each other, the paper's comparison on the right of
figure 10; writes baseline_distances.csv and the tables of README.md, two minutes.

  distances.py [--show]
"""

import sys
import tempfile
from collections import namedtuple
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from benchmark_runs import Failed, checked, figure, markdown, options_of, publish, run  # noqa: E402
from body_surface import BadFile, Body  # noqa: E402
from surface_distance import distances, lowest, size  # noqa: E402

Run = namedtuple("Run", "element mesh_size")
# The paper has P1-P1 at 0.0065 m and P3 at 0.015 m, of an arm whose dimensions it does not tell.
FINEST = [Run("P1", 0.009), Run("P1-P1", 0.009), Run("P2", 0.0175), Run("P3", 0.025)]
CUBIC, TRUTH = Run("P3", 0.025), Run("P3-P2", 0.0175)


def body_of(program, folder, which):
    """The deformed body, of a run in FOLDER."""
    output = Path(folder) / f"{which.element}_{which.mesh_size}"
    row = run(program, HERE / "study.prm",
              {"Method/Element": which.element, "Scene/Mesh size": which.mesh_size,
               "Study/Reference values": "", "Output/VTU": "final"}, output=output)
    if row["load factor"] != "1":
        raise Failed(f"{which.element} at {which.mesh_size} m did not converge: {row['reason']}")
    return Body(output / "solution.pvd")


def compare(which, other, bodies):
    there, back = (distances(bodies[a], bodies[b]) for a, b in ((which, other), (other, which)))
    hausdorff = max(there.largest, back.largest)
    return {"element": which.element, "mesh size [m]": which.mesh_size, "from": other.element,
            "largest [m]": there.largest, "largest back [m]": back.largest,
            "mean [m]": there.mean, "mean back [m]": back.mean,
            "Hausdorff distance [m]": hausdorff,
            "Hausdorff distance, relative": hausdorff / size(bodies[other]),
            "lowest y [m]": lowest(bodies[which]), "lowest y of the other [m]": lowest(bodies[other])}


def table(rows):
    metres = ["largest [m]", "largest back [m]", "mean [m]", "mean back [m]"]
    return markdown(
        ["element", "mesh size", "from", *metres, "Hausdorff, of the length", "lowest y [m]"],
        [[row["element"], row["mesh size [m]"], row["from"], *(figure(row[m], 3) for m in metres),
          f"{100 * row['Hausdorff distance, relative']:.2g} %", figure(row["lowest y [m]"], 4)]
         for row in rows])


def main():
    options = checked(options_of(__doc__).parse_args())
    try:
        with tempfile.TemporaryDirectory() as folder:
            bodies = {which: body_of(options.isochor, folder, which) for which in [*FINEST, TRUTH]}
        rows = [compare(which, CUBIC, bodies) for which in FINEST if which != CUBIC]
        rows += [compare(which, TRUTH, bodies) for which in FINEST]
    except (Failed, BadFile, OSError) as error:
        sys.exit(f"distances.py: error: {error}")
    publish(HERE, rows, {"distances": table(rows)}, options.show, "baseline_distances.csv")


if __name__ == "__main__":
    main()
