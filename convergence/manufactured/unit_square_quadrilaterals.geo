// The unit square, unstructured quadrilaterals. Triangles are paired, and all cells halved so that no
// triangle is left: the edges are about half of size.

Include "unit_square.geo";

Mesh.RecombineAll         = 1;
Mesh.SubdivisionAlgorithm = 1;
