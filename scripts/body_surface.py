"""The surface of a deformed body from VTU files of isochor, for pictures.

The output of deal.II repeats its points from cell to cell, so that fields may jump; the surface
keeps these jumps, and only coordinates decide which faces are inside the body.
"""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

TETRAHEDRON_FACES = [(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)]
TETRAHEDRON_MIDDLES = [(4, 8, 7), (5, 9, 8), (6, 7, 9), (6, 5, 4)]
HEXAHEDRON_FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1),
                    (4, 5, 6, 7)]
# VTK cell type: the faces' corners, and for quadratic cells the nodes in the middle of a face's
# sides, in the same order. A flat cell is its own face.
CELL_TYPES = {
    5: ([(0, 1, 2)], None),
    9: ([(0, 1, 2, 3)], None),
    22: ([(0, 1, 2)], [(3, 4, 5)]),
    69: ([(0, 1, 2)], [(3, 4, 5)]),
    10: (TETRAHEDRON_FACES, None),
    24: (TETRAHEDRON_FACES, TETRAHEDRON_MIDDLES),
    71: (TETRAHEDRON_FACES, TETRAHEDRON_MIDDLES),
    12: (HEXAHEDRON_FACES, None),
}
N_NODES = {5: 3, 9: 4, 22: 6, 69: 6, 10: 4, 24: 10, 71: 10, 12: 8}
FLAT = {5, 9, 22, 69}


vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # errors become a BadFile instead


class BadFile(Exception):
    pass


def last_state(file):
    """FILE itself, or the last data set that a .pvd names."""
    if file.suffix != ".pvd":
        return file
    try:
        sets = ElementTree.parse(file).findall(".//DataSet")
    except (OSError, ElementTree.ParseError) as error:
        raise BadFile(f"{file}: {error}")
    if not sets:
        raise BadFile(f"{file}: names no data set")
    return file.parent / sets[-1].get("file")


def read_grid(file):
    file = last_state(Path(file))
    readers = {".vtu": vtkXMLUnstructuredGridReader, ".pvtu": vtkXMLPUnstructuredGridReader}
    if file.suffix not in readers:
        raise BadFile(f"{file}: not a .vtu, .pvtu or .pvd file")
    if not file.is_file():
        raise BadFile(f"{file}: no such file")
    reader = readers[file.suffix]()
    failures = []
    reader.AddObserver("ErrorEvent", lambda *_: failures.append(True))
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    if failures or grid.GetNumberOfCells() == 0:
        raise BadFile(f"{file}: not a VTK file with cells, or torn")
    return grid


def merged_ids(points):
    """A number for each point, the same for points at the same place up to rounding."""
    tolerance = 2e-6 * np.linalg.norm(np.ptp(points, axis=0))
    labels = np.empty(points.shape, dtype=np.int64)
    for axis in range(3):
        order = np.argsort(points[:, axis])
        steps = np.diff(points[order, axis], prepend=points[order[0], axis]) > tolerance
        labels[order, axis] = np.cumsum(steps)
    return np.unique(labels, axis=0, return_inverse=True)[1].reshape(-1)


def triangles_of(corners, middles):
    if middles is not None:
        (a, b, c), (ab, bc, ca) = corners.T, middles.T
        return np.vstack([np.column_stack(t)
                          for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    if corners.shape[1] == 4:
        return np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]])
    return corners


class Body:
    """One body at rest and deformed.

    rest, deformed   positions of all points
    triangles        of the surface, indices of points
    edges            of the mesh on the surface, pairs of indices
    outside          merged triangles, for the outline of the body at rest
    """

    def __init__(self, file):
        self.file = file
        grid = read_grid(file)
        self.point_data = grid.GetPointData()
        self.rest = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        displacement = self.array("displacement")
        if displacement.ndim != 2 or displacement.shape[1] < 2:
            raise BadFile(f"{file}: 'displacement' is not a vector")
        padded = np.zeros_like(self.rest)
        padded[:, :displacement.shape[1]] = displacement
        self.deformed = self.rest + padded
        types = vtk_to_numpy(grid.GetCellTypesArray())
        self.is_flat = bool(set(types) & FLAT)
        self.find_surface(types, grid.GetCells())

    def find_surface(self, types, cells):
        offsets = vtk_to_numpy(cells.GetOffsetsArray())[:-1]
        connectivity = vtk_to_numpy(cells.GetConnectivityArray())
        merged = merged_ids(self.rest)
        triangles, edges, outside = [], [], []
        for cell_type in np.unique(types):
            if cell_type not in CELL_TYPES:
                raise BadFile(f"{self.file}: cells of VTK type {cell_type} are not supported")
            starts = offsets[types == cell_type]
            nodes = connectivity[starts[:, None] + np.arange(N_NODES[cell_type])]
            faces, middle_nodes = CELL_TYPES[cell_type]
            corners = np.vstack([nodes[:, list(face)] for face in faces])
            middles = middle_nodes and np.vstack([nodes[:, list(m)] for m in middle_nodes])
            if cell_type not in FLAT:  # a face that two cells share is inside
                key = np.sort(merged[corners], axis=1)
                _, inverse, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)
                kept = count[inverse.reshape(-1)] == 1
                corners = corners[kept]
                middles = None if middles is None else middles[kept]
            ends = np.roll(corners, -1, axis=1)
            if middles is None:
                edges.append(np.column_stack([corners.ravel(), ends.ravel()]))
            else:
                edges += [np.column_stack([corners.ravel(), middles.ravel()]),
                          np.column_stack([middles.ravel(), ends.ravel()])]
            found = triangles_of(corners, middles)
            triangles.append(found)
            outside.append(merged[found])
        self.triangles = np.vstack(triangles)
        self.edges = np.vstack(edges)
        self.outside = np.vstack(outside)
        self.place_of_merged = np.empty((merged.max() + 1, 3))
        self.place_of_merged[merged] = self.rest

    def array(self, name):
        """The point data NAME, whatever its spelling: "von Mises stress" is von_Mises_stress."""
        def plain(text):
            return "".join(c for c in text.split("[")[0].lower() if c.isalnum())

        names = [self.point_data.GetArrayName(i)
                 for i in range(self.point_data.GetNumberOfArrays())]
        for candidate in names:
            if plain(candidate) == plain(name):
                return vtk_to_numpy(self.point_data.GetArray(candidate))
        raise BadFile(f"{self.file}: no point data named '{name}'; "
                      f"there is {', '.join(names) or 'none'}")

    def field(self, name):
        """A scalar per point; of a vector its magnitude."""
        values = self.array(name).astype(float)
        return values if values.ndim == 1 else np.linalg.norm(values, axis=1)

    def surface(self, values):
        data = poly_data(self.deformed, self.triangles)
        scalars = numpy_to_vtk(values, deep=True)
        scalars.SetName("field")
        data.GetPointData().SetScalars(scalars)
        return data

    def mesh_lines(self):
        return poly_data(self.deformed, self.edges, lines=True)

    def outline(self):
        """Sharp edges of the body at rest; of a flat body, its rim."""
        edges = vtkFeatureEdges()
        edges.SetInputData(poly_data(self.place_of_merged, self.outside))
        edges.SetFeatureAngle(35)
        edges.BoundaryEdgesOn()
        edges.NonManifoldEdgesOff()
        edges.ManifoldEdgesOff()
        edges.ColoringOff()
        edges.Update()
        return edges.GetOutput()


def poly_data(points, cells, lines=False):
    """Triangles, or lines between two points."""
    data, places, array = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    n_nodes = cells.shape[1]
    array.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, cells.size + 1, n_nodes, dtype=np.int64), deep=True),
        numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, dtype=np.int64).ravel(), deep=True))
    data.SetPoints(places)
    (data.SetLines if lines else data.SetPolys)(array)
    return data
