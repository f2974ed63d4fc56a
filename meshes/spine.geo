// A soft robot arm along x, a spine: vertebrae that are waves of a body of revolution, with necks
// between them and at both ends. Our choice: the paper shows the arm (Locking-Proof Tetrahedra, figures
// 4 and 5) but gives no dimensions; with these the tip sinks about as far as in its table 2.
// Unstructured Delaunay tetrahedra of one edge length; or hexahedra, a square core and four blocks
// around it.

DefineConstant[ size = 0.025 ];  // edge length, m
DefineConstant[ hexahedra = 0 ]; // 1: hexahedra

DefineConstant[ vertebrae = 5 ];
length          = 0.400; // m
neck_radius     = 0.045; // m
vertebra_radius = 0.072; // m

SetFactory("OpenCASCADE");
n    = 2 * vertebrae;
half = length / n; // from a neck to the middle of a vertebra

// The profile, half a wave at a time, along x at both ends of each.
For i In {0:n}
  Point(1 + i) = { i * half, (i % 2) ? vertebra_radius : neck_radius, 0 };
EndFor
For i In {1:n}
  from = (i % 2) ? neck_radius : vertebra_radius;
  to   = (i % 2) ? vertebra_radius : neck_radius;
  a = newp; Point(a) = { (i - 0.5) * half, from, 0 };
  b = newp; Point(b) = { (i - 0.5) * half, to, 0 };
  Bezier(i) = { i, a, b, 1 + i };
EndFor
a = newp; Point(a) = { 0, 0, 0 };
b = newp; Point(b) = { length, 0, 0 };
Line(n + 1) = { n + 1, b };
Line(n + 2) = { b, a };
Line(n + 3) = { a, 1 };
Curve Loop(1)    = { 1 : n + 3 };
Plane Surface(1) = { 1 };
Rotate{ { 1, 0, 0 }, { 0, 0, 0 }, Pi / 4 }{ Surface{1}; } // the seam, where hexahedra have corners
body[] = Extrude{ { 1, 0, 0 }, { 0, 0, 0 }, 2 * Pi }{ Surface{1}; };
Recursive Delete{ Surface{1}; }

far = 2 * vertebra_radius; // outside of the body

If (hexahedra)
  // A square core and four blocks around it, in slices of half a wave: the body cut by their sides.
  core   = neck_radius / 2; // half the width
  cuts[] = {};
  For k In {0:3}
    s = news; Rectangle(s) = { 0, -core, core, length, 2 * core };
    Rotate{ { 1, 0, 0 }, { 0, 0, 0 }, k * Pi / 2 }{ Surface{s}; }
    cuts[] += s;
    s = news; Rectangle(s) = { 0, Sqrt(2) * core, 0, length, far };
    Rotate{ { 1, 0, 0 }, { 0, 0, 0 }, (k + 0.5) * Pi / 2 }{ Surface{s}; }
    cuts[] += s;
  EndFor
  For i In {1:n - 1}
    s = news; Rectangle(s) = { -far, -far, 0, 2 * far, 2 * far };
    Rotate{ { 0, 1, 0 }, { 0, 0, 0 }, Pi / 2 }{ Surface{s}; }
    Translate{ i * half, 0, 0 }{ Surface{s}; }
    cuts[] += s;
  EndFor
  BooleanFragments{ Volume{ body[1] }; Delete; }{ Surface{ cuts[] }; Delete; }
  sides[]   = Abs(Boundary{ Volume{:}; });
  outside[] = Surface{:};
  outside[] -= { sides[] };
  Recursive Delete{ Surface{ outside[] }; }

  mean_radius = (neck_radius + vertebra_radius) / 2;
  along[]  = {}; // the curves, by their direction
  across[] = {};
  around[] = {};
  curves[] = Curve{:};
  For i In {0:#curves[] - 1}
    c = curves[i];
    box() = BoundingBox Curve{c}; // three minima, three maxima
    dy = box(4) - box(1);
    dz = box(5) - box(2);
    If (box(3) - box(0) > half / 2)
      along[] += c;
    ElseIf (Fabs(dy - dz) < core / 10) // on a diagonal
      across[] += c;
    Else
      around[] += c;
    EndIf
  EndFor
  quarter = core + Pi / 4 * mean_radius; // mean length
  Transfinite Curve{ along[] }  = Max(1, Floor(half / size + 0.5)) + 1;
  Transfinite Curve{ across[] } = Max(1, Floor((mean_radius - Sqrt(2) * core) / size + 0.5)) + 1;
  Transfinite Curve{ around[] } = Max(1, Floor(quarter / size + 0.5)) + 1;
  Transfinite Surface{:};
  Recombine Surface{:};
  Transfinite Volume{:};
Else
  MeshSize{ PointsOf{ Volume{:}; } } = size;
EndIf

near    = half / 10;
left[]  = Surface In BoundingBox{ -near, -far, -far, near, far, far };
right[] = Surface In BoundingBox{ length - near, -far, -far, length + near, far, far };
side[]  = CombinedBoundary{ Volume{:}; };
side[]  = Abs(side[]);
side[] -= { left[], right[] };

Physical Surface("left")  = { left[] };
Physical Surface("right") = { right[] };
Physical Surface("side")  = { side[] };
Physical Volume("body")   = { Volume{:} };

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
