#!/usr/bin/python3
"""Chart of this study's baselines, the paper's figure 10: deflection, and its error, against the number of
unknowns, a line per element; writes convergence.png beside this file."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from matplotlib.ticker import FuncFormatter  # noqa: E402

from chart_style import percent, plt, style  # noqa: E402
from results_table import Study, failed, groups, number  # noqa: E402


def main():
    studies = [Study(HERE / f"baseline{part}.csv") for part in ("", "_quadratic", "_cubic")]
    figure, (deflections, errors) = plt.subplots(1, 2, figsize=(11, 4.8), layout="constrained")
    handles = {}
    for study in studies:
        for method, rows in groups(study.runs, study.method).items():
            runs = sorted((number(row["unknowns"]), row) for row in rows if not failed(row))
            unknowns = [n for n, _ in runs]
            handles[method], = deflections.plot(
                unknowns, [100 * number(row["tip [m]"]) for _, row in runs],
                **style(study, method))
            points = [(n, error) for n, row in runs if (error := number(row["tip error"]))]
            errors.plot(*zip(*points), **style(study, method))
    for axes, label in ((deflections, "tip [cm]"), (errors, "relative error of tip")):
        axes.set(xscale="log", xlabel="unknowns", ylabel=label)
        axes.grid(True, color="#dddddd")
        axes.spines[["top", "right"]].set_visible(False)
    errors.set_yscale("log")
    uncertainty = number(studies[1].runs[0]["tip reference uncertainty"])
    errors.set_ylim(0.015, 1.2)
    errors.axhspan(0.015, uncertainty, color="#BBBBBB", alpha=0.45, linewidth=0)
    errors.yaxis.set_major_formatter(FuncFormatter(percent))
    figure.suptitle("Spine robot arm under gravity, ν = 0.4999", fontweight="bold")
    handles["reference's own\nuncertainty"] = plt.Rectangle((0, 0), 1, 1, color="#BBBBBB", alpha=0.45)
    errors.legend(handles.values(), handles, loc="upper left", bbox_to_anchor=(1.02, 1),
                  title="Element", frameon=False)
    figure.savefig(HERE / "convergence.png", dpi=120)


if __name__ == "__main__":
    main()
