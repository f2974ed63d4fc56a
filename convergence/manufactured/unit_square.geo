// The unit square, unstructured triangles of one edge length.

DefineConstant[ size = 0.1 ]; // edge length, m

SetFactory("OpenCASCADE");
Rectangle(1) = { 0, 0, 0, 1, 1 };
MeshSize{ PointsOf{ Surface{1}; } } = size;

Physical Curve("bottom") = {1};
Physical Curve("right")  = {2};
Physical Curve("top")    = {3};
Physical Curve("left")   = {4};
Physical Surface("body") = {1};

Mesh.Algorithm = 6; // Frontal-Delaunay
