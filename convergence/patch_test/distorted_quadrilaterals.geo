// The same square cut into quadrilaterals.

Include "distorted_square.geo";

Mesh.RecombineAll         = 1;
Mesh.SubdivisionAlgorithm = 1; // leaves no triangle
