// A quarter of a ring, plane: inner radius 1, outer radius 2 (metres), between the axes.
// Symmetry: hold y on "bottom" (the x axis) and x on "left" (the y axis).

DefineConstant[ size = 0.25 ];   // edge length
DefineConstant[ hexahedra = 0 ]; // 1: quadrilaterals, in rings

inner_radius = 1;
outer_radius = 2;

Point(1) = {0, 0, 0, size};
Point(2) = {inner_radius, 0, 0, size};
Point(3) = {outer_radius, 0, 0, size};
Point(4) = {0, outer_radius, 0, size};
Point(5) = {0, inner_radius, 0, size};

Line(1)   = {2, 3};
Circle(2) = {3, 1, 4};
Line(3)   = {4, 5};
Circle(4) = {5, 1, 2};

Curve Loop(1)    = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Curve("bottom") = {1};
Physical Curve("outer")  = {2};
Physical Curve("left")   = {3};
Physical Curve("inner")  = {4};
Physical Surface("body") = {1};

If (hexahedra)
  Transfinite Curve{1, 3} = Max(1, Floor((outer_radius - inner_radius) / size + 0.5)) + 1;
  Transfinite Curve{2, 4} = Max(1, Floor(Pi / 4 * (inner_radius + outer_radius) / size + 0.5)) + 1;
  Transfinite Surface{1};
  Recombine Surface{1};
EndIf
