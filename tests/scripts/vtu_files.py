"""VTU files made by hand, as isochor writes them."""

import numpy as np

# The unit cube's six tetrahedra around the diagonal from 0 to 7; vertex x + 2 y + 4 z.
TETRAHEDRA = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
SIDES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]


def vertex(i):
    return np.array([i & 1, i >> 1 & 1, i >> 2 & 1], dtype=float)


def write_vtu(file, cells, cell_type, displacement):
    """CELLS: per cell its points, repeated from cell to cell as deal.II writes them."""
    points = np.vstack(cells)
    n_nodes = len(cells[0])

    def array(name, values, kind="Float32", components=1):
        text = " ".join(map(str, np.asarray(values).ravel()))
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '
                f'format="ascii">{text}</DataArray>')

    file.write_text(
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">'
        f'<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">'
        "<PointData>" + array("displacement", displacement(points), components=3)
        + array("von_Mises_stress", 1e4 * points[:, 0]) + array("J", np.ones(len(points)))
        + "</PointData><Points>" + array("points", points, components=3) + "</Points><Cells>"
        + array("connectivity", np.arange(len(points)), "Int32")
        + array("offsets", n_nodes * np.arange(1, len(cells) + 1), "Int32")
        + array("types", [cell_type] * len(cells), "UInt8")
        + "</Cells></Piece></UnstructuredGrid></VTKFile>")
