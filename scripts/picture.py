#!/usr/bin/python3
"""A picture of deformed bodies, side by side, from VTU files of isochor. Needs no display.

  picture.py -o out.png [--field NAME] [--label TEXT]... FILE...
  picture.py -o out.png --study FOLDER "Element = P1; Poisson ratio = 0.4999" ...

Each body is drawn deformed, with its mesh, coloured by a field, together with the sharp edges of
the body at rest in grey. All share one camera and one colour scale. VTK draws, matplotlib sets
the labels and the colour bar.
"""

import argparse
import os
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.ticker import EngFormatter, ScalarFormatter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (provides the renderer)

from body_surface import BadFile, Body
from results_table import BadTable, Study

UNITS = {"displacement": "m", "von mises stress": "Pa", "pressure": "Pa", "j": ""}
SUPERSAMPLING = 2
PANEL_PIXELS = 1.1e6  # of one body's panel, about


class NoDisplay(Exception):
    pass


@contextmanager
def virtual_display():
    """Debian's VTK draws through an X server only; ours has no screen and no network."""
    if not shutil.which("Xvfb"):
        if os.environ.get("DISPLAY"):
            yield
            return
        raise NoDisplay("drawing needs Xvfb: install Debian's package xvfb")
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "64x64x24", "-nolisten", "tcp"],
        pass_fds=[write_end], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE, text=True)
    os.close(write_end)
    try:
        with os.fdopen(read_end) as stream:
            number = stream.readline().strip()  # empty if the server gave up
        if not number:
            raise NoDisplay(f"Xvfb did not start: {server.stderr.read().strip()}")
        os.environ["DISPLAY"] = f":{number}"
        yield
    finally:
        server.terminate()
        server.wait()


class Camera:
    """One parallel view that holds all bodies, at rest and deformed, without waste."""

    def __init__(self, bodies, direction):
        flat = all(body.is_flat for body in bodies)
        back = np.array([0, 0, 1.0] if flat else direction)
        self.back = back / np.linalg.norm(back)
        up = np.array([0, 1.0, 0]) if abs(self.back[1]) < 0.99 else np.array([0, 0, -1.0])
        right = np.cross(up, self.back)
        self.right = right / np.linalg.norm(right)
        self.up = np.cross(self.back, self.right)
        points = np.vstack([points for body in bodies for points in (body.rest, body.deformed)])
        axes = np.array([self.right, self.up, self.back])
        low, high = (points @ axes.T).min(axis=0), (points @ axes.T).max(axis=0)
        self.centre = (low + high) / 2 @ axes
        self.size = (high - low) * 1.05
        self.size[:2] = np.maximum(self.size[:2], 0.05 * self.size[:2].max())

    def apply(self, renderer):
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(self.centre)
        camera.SetPosition(self.centre + self.back * np.linalg.norm(self.size))
        camera.SetViewUp(self.up)
        camera.SetParallelScale(self.size[1] / 2)
        renderer.ResetCameraClippingRange()


class Colours:
    """One scale for all bodies. A few extreme points, as at clamped corners, do not set it."""

    def __init__(self, bodies, field, limits):
        key = field.split("[")[0].strip().lower()
        self.unit = (field.split("[")[1].split("]")[0] if "[" in field else UNITS.get(key, ""))
        self.name = field.split("[")[0].strip()
        values = np.concatenate([body.field(field)[body.triangles].ravel() for body in bodies])
        if not np.isfinite(values).all():
            raise BadFile(f"'{field}' is not finite everywhere")
        low, high = limits or np.percentile(values, [1, 99])
        neutral = {"j": 1.0, "pressure": 0.0}.get(key)
        # Without viridis' darkest part, on which no mesh line is seen.
        self.map = ListedColormap(plt.get_cmap("viridis")(np.linspace(0.22, 1, 256)))
        if neutral is not None and not limits and (key == "j" or low < neutral < high):
            reach = max(abs(low - neutral), abs(high - neutral))
            low, high = neutral - reach, neutral + reach
            self.map = plt.get_cmap("RdBu_r")
        if not high - low > 1e-9 * max(abs(low), abs(high)):
            middle, reach = (low + high) / 2, max(abs(low) * 1e-3, 1e-12)
            low, high = middle - reach, middle + reach
        self.norm = Normalize(low, high)
        slack = 1e-3 * (high - low)
        below, above = values.min() < low - slack, values.max() > high + slack
        self.extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[
            int(below), int(above)]

    def lookup_table(self):
        table = vtkLookupTable()
        table.SetNumberOfTableValues(256)
        for i, colour in enumerate(self.map(np.linspace(0, 1, 256))):
            table.SetTableValue(i, *colour)
        table.SetRange(self.norm.vmin, self.norm.vmax)
        table.Build()
        return table

    def formatter(self):
        if self.unit == "Pa":
            return EngFormatter(unit="Pa")
        formatter = ScalarFormatter(useOffset=False)
        formatter.set_powerlimits((-4, 5))
        return formatter

    def label(self):
        return self.name + (f" [{self.unit}]" if self.unit and self.unit != "Pa" else "")


def actor(data, colour=None, line_width=None):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    drawn = vtkActor()
    drawn.SetMapper(mapper)
    if colour:
        mapper.ScalarVisibilityOff()
        drawn.GetProperty().SetColor(*colour)
        drawn.GetProperty().LightingOff()
        drawn.GetProperty().SetLineWidth(line_width * SUPERSAMPLING)
    return drawn


def draw(body, field, colours, camera, pixels):
    """An RGB image of one body."""
    surface = actor(body.surface(body.field(field)))
    mapper = surface.GetMapper()
    mapper.SetLookupTable(colours.lookup_table())
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    surface.GetProperty().SetInterpolationToFlat()
    surface.GetProperty().SetAmbient(0.6)
    surface.GetProperty().SetDiffuse(0.42)
    # Lines lie on the surface: draw the surface a little behind itself.
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(1, 1)

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(surface)
    renderer.AddActor(actor(body.mesh_lines(), (0.1, 0.1, 0.1), 0.8))
    renderer.AddActor(actor(body.outline(), (0.55, 0.55, 0.55), 1.2))
    camera.apply(renderer)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(*(int(SUPERSAMPLING * n) for n in pixels))
    window.AddRenderer(renderer)
    window.Render()

    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    picture = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
    window.Finalize()
    n = SUPERSAMPLING
    tidy = picture[:height // n * n, :width // n * n].astype(float)
    return tidy.reshape(height // n, n, width // n, n, 3).mean(axis=(1, 3)).astype(np.uint8)


def compose(images, labels, colours, output):
    dpi = 160
    height, width = (n / dpi for n in images[0].shape[:2])
    label_height, gap, bar = 0.5, 0.25, 1.4
    figure_width = len(images) * (width + gap) + bar
    figure_height = height + label_height + gap
    figure = plt.figure(figsize=(figure_width, figure_height), dpi=dpi)
    for i, (image, label) in enumerate(zip(images, labels)):
        place = ((gap / 2 + i * (width + gap)) / figure_width, label_height / figure_height,
                 width / figure_width, height / figure_height)
        axes = figure.add_axes(place)
        axes.imshow(image, interpolation="nearest", aspect="auto")
        axes.axis("off")
        figure.text(place[0] + place[2] / 2, 0.55 * label_height / figure_height, label,
                    ha="center", va="center", fontsize=13)
    bar_axes = figure.add_axes(((figure_width - bar + 0.15) / figure_width,
                                (label_height + 0.06 * height) / figure_height,
                                0.16 / figure_width, 0.88 * height / figure_height))
    figure.colorbar(plt.cm.ScalarMappable(colours.norm, colours.map), cax=bar_axes,
                    extend=colours.extend, format=colours.formatter(), label=colours.label())
    figure.savefig(output, facecolor="white")


def states_of_study(folder, wanted):
    """The last state of each run of a study, and a label that tells its settings."""
    study = Study(folder / "results.csv")
    if "folder" not in study.columns:
        raise BadTable(f"{folder}/results.csv: no column named 'folder' tells where a run's files are")
    rows = [study.find(text) for text in wanted]
    return [folder / row["folder"] / "solution.pvd" for row in rows], list(map(study.label, rows))


def main():
    parser = argparse.ArgumentParser(description="A picture of deformed bodies, side by side.")
    parser.add_argument("files", nargs="+", metavar="FILE",
                        help=".vtu, .pvtu, .pvd (its last state); with --study, settings of a run")
    parser.add_argument("--study", type=Path, metavar="FOLDER", help="output folder of a study")
    parser.add_argument("-o", "--output", required=True, type=Path, help="the .png to write")
    parser.add_argument("--field", default="von Mises stress [Pa]",
                        help="colours: displacement, pressure, J, von Mises stress (default)")
    parser.add_argument("--label", action="append", default=[], help="text below each body")
    parser.add_argument("--limits", nargs=2, type=float, metavar=("LOW", "HIGH"),
                        help="of the colours; default: what 98 %% of the surface has")
    parser.add_argument("--view", nargs=3, type=float, default=[0.35, 0.3, 1.0],
                        metavar=("X", "Y", "Z"), help="direction to the viewer; y is up")
    options = parser.parse_args()
    if options.label and len(options.label) != len(options.files):
        parser.error(f"{len(options.files)} files, {len(options.label)} labels")
    try:
        files, labels = options.files, [Path(file).stem for file in options.files]
        if options.study:
            files, labels = states_of_study(options.study, options.files)
        labels = options.label or labels
        bodies = [Body(file) for file in files]
        colours = Colours(bodies, options.field, options.limits)
        camera = Camera(bodies, options.view)
        aspect = camera.size[0] / camera.size[1]
        pixels = np.sqrt(PANEL_PIXELS * aspect), np.sqrt(PANEL_PIXELS / aspect)
        pixels = [int(n / max(1, max(pixels) / 1500)) for n in pixels]
        with virtual_display():
            images = [draw(body, options.field, colours, camera, pixels) for body in bodies]
        compose(images, labels, colours, options.output)
    except (BadFile, BadTable, NoDisplay, OSError) as error:
        sys.exit(f"picture.py: error: {error}")
    print(options.output)


if __name__ == "__main__":
    main()
