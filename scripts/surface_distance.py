#!/usr/bin/python3
"""The Hausdorff distance between the deformed surfaces of two bodies, from VTU files of isochor.

  surface_distance.py FILE OTHER

FILE, OTHER: .vtu, .pvtu, .pvd (its last state). Of every triangle of a surface the corners, the middles
of the sides and the centroid are measured, to the nearest point of the other surface. Printed are, in
m and relative to the length of OTHER's bounding box at rest, from corner to corner: the largest and
the mean distance in both directions, the larger of the largest (the Hausdorff distance), and the
lowest y of both.
"""

import argparse
import sys
from collections import namedtuple
from pathlib import Path

import numpy as np
from vtkmodules.vtkCommonCore import mutable
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator

from body_surface import BadFile, Body, poly_data

# Barycentric coordinates of the points that are measured, and their weights in a mean; the rule is
# exact for cubic polynomials.
POINTS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [.5, .5, 0], [0, .5, .5], [.5, 0, .5],
                   [1 / 3] * 3])
WEIGHTS = np.array([3, 3, 3, 8, 8, 8, 27]) / 60

Distances = namedtuple("Distances", "largest mean")  # of one surface from another, m


def size(body):
    """Of the body at rest, from corner to corner of its bounding box, m."""
    return np.linalg.norm(np.ptp(body.rest, axis=0))


def lowest(body):
    """The lowest y of the deformed body, m."""
    return body.deformed[:, 1].min()


def distances(body, other):
    """Of BODY's deformed surface from OTHER's, the mean by area. Throws BadFile for a flat body."""
    for flat in filter(lambda b: b.is_flat, (body, other)):
        raise BadFile(f"{flat.file}: a flat body, which has no surface")
    triangles = body.deformed[body.triangles]
    places, index = np.unique((POINTS @ triangles).reshape(-1, 3), axis=0, return_inverse=True)
    surface = poly_data(other.deformed, other.triangles)
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    nearest, cell, part, squared = [0., 0., 0.], mutable(0), mutable(0), mutable(0.)
    found = np.empty(len(places))
    for i, place in enumerate(places):
        locator.FindClosestPoint(place, nearest, cell, part, squared)
        found[i] = np.sqrt(float(squared))
    a, b, c = triangles.transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    means = found[index.reshape(-1, len(POINTS))] @ WEIGHTS
    return Distances(found.max(), area @ means / area.sum())


def main():
    parser = argparse.ArgumentParser(
        description="The distance between the deformed surfaces of two bodies.")
    parser.add_argument("file", metavar="FILE", help=".vtu, .pvtu, .pvd (its last state)")
    parser.add_argument("other", metavar="OTHER", help="what it is measured from")
    options = parser.parse_args()
    try:
        body, other = Body(options.file), Body(options.other)
        there, back = distances(body, other), distances(other, body)
    except (BadFile, OSError) as error:
        sys.exit(f"surface_distance.py: error: {error}")
    length = size(other)
    names = Path(options.file).name, Path(options.other).name
    for what, value in ((f"largest, {names[0]} from {names[1]}", there.largest),
                        (f"largest, {names[1]} from {names[0]}", back.largest),
                        ("Hausdorff distance", max(there.largest, back.largest)),
                        (f"mean, {names[0]} from {names[1]}", there.mean),
                        (f"mean, {names[1]} from {names[0]}", back.mean)):
        print(f"{what}: {value:.6g} m, {100 * value / length:.4g} %")
    for name, which in zip(names, (body, other)):
        print(f"lowest y, {name}: {lowest(which):.6g} m")


if __name__ == "__main__":
    main()
