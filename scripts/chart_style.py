"""What the charts of studies have in common: colours, axes, failed runs, the legend, files."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from matplotlib.transforms import Bbox, ScaledTranslation

from results_table import failed, groups, number

plt.rcParams.update({"font.size": 10, "svg.hashsalt": "isochor"})

# Okabe and Ito: told apart by colour-blind readers. Black is kept for the reference.
COLOURS = ["#D55E00", "#E69F00", "#009E73", "#0072B2", "#56B4E9", "#CC79A7", "#7F7F7F", "#8B5A2B"]
# A colour of its own for each of these in every study; others take colours as they come.
ELEMENTS = ["P1", "P2", "P3", "P1-P1", "P2-P1", "P3-P2", "P1-P1s", "MINI", "P1-P0", "P2-P0",
            "Q1", "Q2", "Q1-P0", "Q2-P1"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "h"]
DASHES = ["-", (0, (4, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1))]

STRIP = 0.07  # height of the strip of failed runs, as part of the axes


def style(study, method):
    known = ELEMENTS if set(study.methods) <= set(ELEMENTS) else study.methods
    i = known.index(method)
    return dict(color=COLOURS[i % len(COLOURS)], marker=MARKERS[i % len(MARKERS)],
                linestyle=DASHES[i // len(COLOURS) % len(DASHES)])


def percent(value, _position=None):
    return f"{100 * value:.10g} %"


def plain(value, _position=None):
    return f"{value:.10g}"


def log_axis(axis, formatter):
    log_ticks(axis, *axis.get_view_interval(), formatter)


def log_ticks(axis, low, high, formatter):
    """Labels at round numbers, more of them where LOW to HIGH is a short way."""
    subs = (1, 2, 5) if high < 50 * low else (1, 3) if high < 500 * low else (1,)
    axis.set_major_locator(LogLocator(subs=subs, numticks=12))
    axis.set_major_formatter(FuncFormatter(formatter))
    axis.set_minor_formatter(NullFormatter())


def new_figure(title, panels, n_columns=None, share_x=True):
    """The figure, and pairs of axes and runs."""
    n_columns = n_columns or (min(len(panels), 2) if len(panels) <= 4 else 3)
    n_rows = math.ceil(len(panels) / n_columns)
    size = (8.4, 4.8) if len(panels) == 1 else (2.2 + 4.1 * n_columns, 0.9 + 3.3 * n_rows)
    figure, all_axes = plt.subplots(n_rows, n_columns, figsize=size, squeeze=False, sharey=True,
                                    sharex=share_x, layout="constrained")
    figure.suptitle(title, fontsize=12, fontweight="bold")
    for unused in all_axes.flat[len(panels):]:
        unused.remove()
    for i, (axes, (name, _)) in enumerate(zip(all_axes.flat, panels)):
        axes.set_title(name, fontsize=10)
        axes.grid(True, which="major", color="#DDDDDD", linewidth=0.7)
        axes.set_axisbelow(True)
        axes.spines[["top", "right"]].set_visible(False)
        axes.tick_params(labelbottom=i + n_columns >= len(panels))
    return figure, [(axes, rows) for axes, (_, rows) in zip(all_axes.flat, panels)]


def draw_failed(axes, study, rows, position):
    """Crosses in a strip at the upper edge that no figure reaches; side by side at one place."""
    places = groups([row for row in rows if position(row) is not None], position)
    if not places:
        return
    axes.add_patch(plt.Rectangle((0, 1 - STRIP), 1, STRIP, transform=axes.transAxes,
                                 color="#F6E3E3", linewidth=0, zorder=0))
    for x, here in places.items():
        for i, row in enumerate(here):
            shift = ScaledTranslation((i - (len(here) - 1) / 2) * 10 / 72, 0,
                                      axes.figure.dpi_scale_trans)
            axes.plot(x, 1 - STRIP / 2, "x", markersize=7.5, markeredgewidth=2.2, zorder=5,
                      color=style(study, study.method(row))["color"],
                      transform=axes.get_xaxis_transform() + shift)


def leave_room_for_strip(axes):
    bottom, top = axes.transScale.transform([(1, y) for y in axes.get_ylim()])[:, 1]
    top = bottom + (top - bottom) / (1 - STRIP)
    axes.set_ylim(top=axes.transScale.inverted().transform((0, top))[1])


def legend(figure, study, any_failed, extra):
    handles = [Line2D([], [], label=m, markersize=6, **style(study, m)) for m in study.methods]
    handles += list(extra)
    if any_failed:
        handles.append(Line2D([], [], linestyle="", marker="x", color="#444444", markersize=8,
                              markeredgewidth=2.2, label="failed"))
    top = [axes for axes in figure.axes if axes.get_subplotspec().is_first_row()]
    top[-1].legend(handles=handles, bbox_to_anchor=(1.03, 1), loc="upper left", borderaxespad=0,
                   frameon=False, title="Method", title_fontproperties={"weight": "bold"},
                   alignment="left")


def save(figure, folder, name):
    written = []
    for ending in ("svg", "png"):
        file = folder / f"{name}.{ending}"
        figure.savefig(file, dpi=160)
        written.append(file)
    plt.close(figure)
    return written


def errors(rows, probe):
    """(row, relative error) of the runs that have one that a logarithmic axis can show."""
    pairs = [(row, number(row[probe.error])) for row in rows if not failed(row)]
    return [(row, abs(error)) for row, error in pairs if error]


def draw_uncertainty(axes, rows, probe, position=None):
    """Below this band an error says nothing: the reference itself is not known better."""
    if not probe.uncertainty:
        return []
    known = [(position(row) if position else 0, number(row[probe.uncertainty])) for row in rows]
    known = sorted((x, abs(u)) for x, u in known if x is not None and u)
    if not known:
        return []
    bottom = min(axes.get_ylim()[0], known[0][1] / 3)
    if position:
        axes.fill_between(*zip(*known), bottom, color="#BBBBBB", alpha=0.45, linewidth=0, zorder=0)
    else:
        axes.axhspan(bottom, max(u for _, u in known), color="#BBBBBB", alpha=0.45, linewidth=0,
                     zorder=0)
    axes.set_ylim(bottom=bottom)
    return [plt.Rectangle((0, 0), 1, 1, color="#BBBBBB", alpha=0.45,
                          label="reference's own\nuncertainty")]


def place_labels(figure, ends):
    """The method's name beside its last point, on the first side with room, if there is any."""
    sides = [((6, 4), "left", "bottom"), ((6, -4), "left", "top"), ((-6, 4), "right", "bottom"),
             ((-6, -4), "right", "top"), ((0, 7), "center", "bottom"), ((0, -7), "center", "top")]
    figure.canvas.draw()
    for axes, labels in ends.items():
        radius = 5 * figure.dpi / 72
        taken = [Bbox.from_extents(*(axes.transData.transform(point) - radius),
                                   *(axes.transData.transform(point) + radius))
                 for point, _ in labels]
        for point, method in labels:
            for offset, horizontal, vertical in sides:
                text = axes.annotate(method, point, xytext=offset, textcoords="offset points",
                                     ha=horizontal, va=vertical, fontsize=8, color="#333333")
                box = text.get_window_extent()
                inside = axes.bbox.x0 <= box.x0 and box.x1 <= axes.bbox.x1
                if inside and not any(box.overlaps(other) for other in taken):
                    taken.append(box)
                    break
                text.remove()
