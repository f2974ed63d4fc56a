// A cantilever of 1 x 0.1 x 0.1 m along x, one corner at the origin.
// Unstructured Delaunay tetrahedra of one edge length; or hexahedra, bricks of about that length.

DefineConstant[ size = 0.05 ];   // edge length, m
DefineConstant[ hexahedra = 0 ]; // 1: hexahedra

DefineConstant[ length = 1.0 ];  // m
width = 0.1;                     // m, along y and z

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

If (hexahedra)
  For i In {1:12}
    box() = BoundingBox Curve{i}; // three minima, three maxima
    edge  = box(3) - box(0) + box(4) - box(1) + box(5) - box(2); // one of them is not zero
    Transfinite Curve{i} = Max(1, Floor(edge / size + 0.5)) + 1;
  EndFor
  Transfinite Surface{:};
  Recombine Surface{:};
  Transfinite Volume{:};
EndIf

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
