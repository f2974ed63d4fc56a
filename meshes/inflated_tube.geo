// A thick tube along z: inner radius 20, outer radius 30, height 80 mm.
// Unstructured Delaunay tetrahedra of one edge length; or hexahedra in rings and layers.

DefineConstant[ size = 0.006 ];  // edge length, m
DefineConstant[ hexahedra = 0 ]; // 1: hexahedra

inner_radius = 0.020; // m
outer_radius = 0.030; // m
height       = 0.080; // m

// The end face at z = 0: two circles of four arcs each, so that vertices lie on both axes.
Point(1) = { 0, 0, 0, size };
For i In {0:3}
  c = Cos(i * Pi / 2);
  s = Sin(i * Pi / 2);
  Point(10 + i) = { inner_radius * c, inner_radius * s, 0, size };
  Point(20 + i) = { outer_radius * c, outer_radius * s, 0, size };
EndFor
For i In {0:3}
  Circle(10 + i) = { 10 + i, 1, 10 + (i + 1) % 4 };
  Circle(20 + i) = { 20 + i, 1, 20 + (i + 1) % 4 };
EndFor
If (hexahedra)
  wall   = Max(1, Floor((outer_radius - inner_radius) / size + 0.5));
  around = Max(1, Floor(Pi / 4 * (inner_radius + outer_radius) / size + 0.5)); // of a quarter
  layers = Max(1, Floor(height / size + 0.5));
  For i In {0:3}
    Line(30 + i) = { 10 + i, 20 + i };
  EndFor
  Transfinite Curve{ 10:13, 20:23 } = around + 1;
  Transfinite Curve{ 30:33 } = wall + 1;
  For i In {0:3}
    next = (i + 1) % 4;
    Curve Loop(1 + i) = { 30 + i, 20 + i, -(30 + next), -(10 + i) };
    Plane Surface(1 + i) = { 1 + i };
  EndFor
  Transfinite Surface{ 1:4 };
  Recombine Surface{ 1:4 };

  // Each extruded: [0] the other end, [1] the volume, then the sides in the order of its loop.
  tops[] = {}; outers[] = {}; inners[] = {}; bodies[] = {};
  For i In {0:3}
    part[] = Extrude{ 0, 0, height }{ Surface{1 + i}; Layers{layers}; Recombine; };
    tops[] += part[0]; bodies[] += part[1]; outers[] += part[3]; inners[] += part[5];
  EndFor

  Physical Surface("bottom") = { 1:4 };
  Physical Surface("top")    = { tops[] };
  Physical Surface("outer")  = { outers[] };
  Physical Surface("inner")  = { inners[] };
  Physical Volume("body")    = { bodies[] };
Else
  Curve Loop(1) = { 20:23 };
  Curve Loop(2) = { 10:13 };
  Plane Surface(1) = { 1, 2 };

  // Extruded: [0] the other end face, [1] the volume, then the sides in the order of the loops.
  tube[] = Extrude{ 0, 0, height }{ Surface{1}; };

  Physical Surface("bottom") = { 1 };
  Physical Surface("top")    = { tube[0] };
  Physical Surface("outer")  = { tube[{2:5}] };
  Physical Surface("inner")  = { tube[{6:9}] };
  Physical Volume("body")    = { tube[1] };
EndIf

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
