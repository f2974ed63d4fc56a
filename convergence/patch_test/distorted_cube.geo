// The unit cube with vertices where they distort the tetrahedra around them.

DefineConstant[ size = 0.5 ]; // edge length, m

SetFactory("OpenCASCADE");
Box(1) = { 0, 0, 0, 1, 1, 1 };
Point(11) = { 0.43, 0.57, 0.38, size };
Point(12) = { 0.52, 0.61, 0.47, size };
MeshSize{ PointsOf{ Volume{1}; } } = size;
Point{11, 12} In Volume{1};

// OpenCASCADE numbers the sides of a box x min, x max, y min, y max, z min, z max.
Physical Surface("left")   = {1};
Physical Surface("right")  = {2};
Physical Surface("bottom") = {3};
Physical Surface("top")    = {4};
Physical Surface("back")   = {5};
Physical Surface("front")  = {6};
Physical Volume("body")    = {1};

Mesh.Algorithm   = 5; // Delaunay
Mesh.Algorithm3D = 1;
Mesh.Optimize    = 0; // leave them distorted
Mesh.Smoothing   = 0;
