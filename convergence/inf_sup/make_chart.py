#!/usr/bin/python3
"""Chart of this study's baselines: inf-sup constant and spurious modes against the mesh, a column per
family of meshes; writes inf_sup.png beside this file."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from chart_style import plt, style  # noqa: E402
from results_table import Study, number  # noqa: E402

FAMILIES = {"baseline.csv": "6-tet split, hexahedra", "baseline_five_tets.csv": "5-tet split",
            "baseline_unstructured.csv": "unstructured"}
COLUMNS = {"inf-sup constant at rest": "inf-sup constant", "spurious modes at rest": "spurious modes"}


def per_edge(row):
    """Cells along an edge of the cube."""
    if "Scene/Cells" in row:
        return number(row["Scene/Cells"].split(",")[0])
    return 1 / number(row["Scene/Mesh size"])


def main():
    figure, axes = plt.subplots(len(COLUMNS), len(FAMILIES), figsize=(11, 6.5), sharex="col",
                                sharey="row", layout="constrained")
    lines = {}
    for column, (file, family) in enumerate(FAMILIES.items()):
        study = Study(HERE / file)
        axes[0][column].set_title(family)
        axes[-1][column].set_xlabel("cells along an edge")
        for row, (name, label) in enumerate(COLUMNS.items()):
            panel = axes[row][column]
            for method in study.methods:
                runs = sorted((per_edge(run), number(run[name])) for run in study.runs
                              if run["Method/Element"] == method)
                lines[method], = panel.plot(*zip(*runs), **style(study, method), label=method)
            panel.grid(True, color="#dddddd")
            panel.set_ylim(bottom=0 if row else 5e-3)
            if row == 0:
                panel.set_yscale("log")
            else:
                panel.set_yscale("symlog", linthresh=1)
            if column == 0:
                panel.set_ylabel(label)
    figure.suptitle("Unit cube, all faces held, at rest", fontweight="bold")
    axes[0][-1].legend(lines.values(), lines, loc="upper left", bbox_to_anchor=(1.02, 1),
                       title="Element")
    figure.savefig(HERE / "inf_sup.png", dpi=120)


if __name__ == "__main__":
    main()
