// The unit square with vertices where they distort the triangles around them.

DefineConstant[ size = 0.4 ]; // edge length, m

SetFactory("OpenCASCADE");
Rectangle(1) = { 0, 0, 0, 1, 1 };
Point(11) = { 0.43, 0.57, 0, size };
Point(12) = { 0.52, 0.61, 0, size };
Point(13) = { 0.21, 0.17, 0, size };
MeshSize{ PointsOf{ Surface{1}; } } = size;
Point{11, 12, 13} In Surface{1};

Physical Curve("bottom") = {1};
Physical Curve("right")  = {2};
Physical Curve("top")    = {3};
Physical Curve("left")   = {4};
Physical Surface("body") = {1};

Mesh.Algorithm = 5;           // Delaunay
Mesh.Smoothing = 0;           // leave them distorted
Mesh.MeshSizeExtendFromBoundary = 1;
