// A cylinder along x. Our choice: the paper stretches one of a length it does not tell (Locking-Proof
// Tetrahedra, figure 13).
// Unstructured Delaunay tetrahedra of one edge length; or hexahedra, extruded in layers.

DefineConstant[ size = 0.01 ];   // edge length, m
DefineConstant[ hexahedra = 0 ]; // 1: hexahedra

radius = 0.050; // m
length = 0.200; // m

// The end face at x = 0: four arcs, so that vertices lie on both axes.
Point(1) = { 0, 0, 0, size };
For i In {0:3}
  c = Cos(i * Pi / 2);
  s = Sin(i * Pi / 2);
  Point(10 + i) = { 0, radius * c, radius * s, size };
EndFor
For i In {0:3}
  Circle(10 + i) = { 10 + i, 1, 10 + (i + 1) % 4 };
EndFor
If (hexahedra)
  // A square core half as wide as the cylinder, corner to corner, and four blocks around it.
  core   = radius / 2;
  around = Max(1, Floor((Pi / 2 * radius + Sqrt(2) * core) / 2 / size + 0.5)); // of a quarter
  across = Max(1, Floor((radius - core) / size + 0.5));
  layers = Max(1, Floor(length / size + 0.5));
  For i In {0:3}
    c = Cos(i * Pi / 2);
    s = Sin(i * Pi / 2);
    Point(20 + i) = { 0, core * c, core * s };
  EndFor
  For i In {0:3}
    Line(20 + i) = { 20 + i, 20 + (i + 1) % 4 };
    Line(30 + i) = { 20 + i, 10 + i };
  EndFor
  Transfinite Curve{ 10:13, 20:23 } = around + 1;
  Transfinite Curve{ 30:33 } = across + 1;
  For i In {0:3}
    Curve Loop(1 + i) = { 10 + i, -(30 + (i + 1) % 4), -(20 + i), 30 + i };
  EndFor
  Curve Loop(5) = { 20:23 };
  ends[] = {}; sides[] = {}; bodies[] = {};
  For i In {1:5}
    Plane Surface(i) = { i };
  EndFor
  Transfinite Surface{ 1:5 };
  Recombine Surface{ 1:5 };

  // Each extruded: [0] the other end, [1] the volume, then the sides in the order of its loop.
  For i In {1:5}
    part[] = Extrude{ length, 0, 0 }{ Surface{i}; Layers{layers}; Recombine; };
    ends[] += part[0]; bodies[] += part[1];
    If (i < 5)
      sides[] += part[2];
    EndIf
  EndFor
  Physical Surface("left")  = { 1:5 };
  Physical Surface("right") = { ends[] };
  Physical Surface("side")  = { sides[] };
  Physical Volume("body")   = { bodies[] };
Else
  Curve Loop(1)    = { 10:13 };
  Plane Surface(1) = { 1 };
  bar[] = Extrude{ length, 0, 0 }{ Surface{1}; };

  Physical Surface("left")  = { 1 };
  Physical Surface("right") = { bar[0] };
  Physical Surface("side")  = { bar[{2:5}] };
  Physical Volume("body")   = { bar[1] };
EndIf

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
