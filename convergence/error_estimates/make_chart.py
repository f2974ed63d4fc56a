#!/usr/bin/python3
"""Chart of this study's baselines: the error that a run estimates of itself against its true error, a point
per run, of all scenes; writes estimates.png beside this file."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from matplotlib.ticker import FuncFormatter  # noqa: E402

from chart_style import percent, plt, style  # noqa: E402
from estimate_tables import judged  # noqa: E402
from results_table import scene_baselines  # noqa: E402

ENDS = (1e-4, 1.)
OWN = {"Q2-P1": {"color": "#D55E00", "marker": "D"}}  # which charts of one scene tell by dashes


def main():
    figure, axes = plt.subplots(figsize=(7.5, 5.6), layout="constrained")
    handles = {}
    for _, file in scene_baselines(HERE):
        study, pairs = judged(file, HERE.parent / "work_precision")
        for row, true, estimate in pairs:
            method = study.method(row)
            look = {**style(study, method), "linestyle": "", **OWN.get(method, {})}
            handles[method], = axes.plot([true], [estimate], **look)
    axes.fill_between(ENDS, [e / 2 for e in ENDS], [2 * e for e in ENDS], color="#BBBBBB", alpha=0.45,
                      linewidth=0, label="within a factor of 2")
    axes.plot(ENDS, ENDS, color="#777777", linewidth=1)
    axes.set(xscale="log", yscale="log", xlim=ENDS, ylim=ENDS, xlabel="true relative error",
             ylabel="estimated by the run itself", title="First probe of all scenes")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(percent))
    axes.grid(True, color="#dddddd")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend([*handles.values(), axes.collections[0]], [*handles, "within a factor\nof 2"],
                loc="upper left", bbox_to_anchor=(1.02, 1), title="Element", frameon=False)
    figure.savefig(HERE / "estimates.png", dpi=120)


if __name__ == "__main__":
    main()
