// A cantilever of 1 x 0.1 x 0.1 m along x, one corner at the origin.
// Unstructured Delaunay tetrahedra of one edge length.

DefineConstant[ size = 0.05 ]; // edge length, m

length = 1.0; // m
width  = 0.1; // m, along y and z

SetFactory("OpenCASCADE");
Box(1) = { 0, 0, 0, length, width, width };
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
