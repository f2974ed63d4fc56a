// The unit cube, unstructured Delaunay tetrahedra of one edge length.

DefineConstant[ size = 0.25 ]; // edge length, m

SetFactory("OpenCASCADE");
Box(1) = { 0, 0, 0, 1, 1, 1 };
MeshSize{ PointsOf{ Volume{1}; } } = size;

// OpenCASCADE numbers the sides of a box x min, x max, y min, y max, z min, z max.
Physical Surface("left")   = {1};
Physical Surface("right")  = {2};
Physical Surface("bottom") = {3};
Physical Surface("top")    = {4};
Physical Surface("back")   = {5};
Physical Surface("front")  = {6};
Physical Volume("body")    = {1};

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
