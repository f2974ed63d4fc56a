// A pneumatic robot, a bubble: a round block, its axis y, with a closed cavity of rounded rim under a
// thin lid. Our choice: the paper shows it (Locking-Proof Tetrahedra, figure 6) but gives no dimensions.
// Unstructured Delaunay tetrahedra of one edge length.

DefineConstant[ size = 0.0052 ]; // edge length, m

radius        = 0.045; // m
height        = 0.025; // m
cavity_radius = 0.035; // m
floor         = 0.008; // m, below the cavity
lid           = 0.005; // m, above it
rim           = 0.004; // m, radius of the cavity's rounded rim

SetFactory("OpenCASCADE");
top = height - lid;

// The profile in the plane of x and y, with its cavity.
Point(1) = { 0, 0, 0 };
Point(2) = { radius, 0, 0 };
Point(3) = { radius, height, 0 };
Point(4) = { 0, height, 0 };
Point(5) = { 0, top, 0 };
Point(6) = { cavity_radius - rim, top, 0 };
Point(7) = { cavity_radius - rim, top - rim, 0 };
Point(8) = { cavity_radius, top - rim, 0 };
Point(9) = { cavity_radius, floor + rim, 0 };
Point(10) = { cavity_radius - rim, floor + rim, 0 };
Point(11) = { cavity_radius - rim, floor, 0 };
Point(12) = { 0, floor, 0 };
Line(1) = { 1, 2 };
Line(2) = { 2, 3 };
Line(3) = { 3, 4 };
Line(4) = { 4, 5 };
Line(5) = { 5, 6 };
Circle(6) = { 6, 7, 8 };
Line(7) = { 8, 9 };
Circle(8) = { 9, 10, 11 };
Line(9) = { 11, 12 };
Line(10) = { 12, 1 };
Curve Loop(1)    = { 1:10 };
Plane Surface(1) = { 1 };
body[] = Extrude{ { 0, 1, 0 }, { 0, 0, 0 }, 2 * Pi }{ Surface{1}; };
Recursive Delete{ Surface{1}; }
MeshSize{ PointsOf{ Volume{:}; } } = size;

// The cavity's surface is what lies inside of the block's.
eps      = rim / 10;
out      = radius + eps;
in       = radius - eps;
bottom[] = Surface In BoundingBox{ -out, -eps, -out, out, eps, out };
top[]    = Surface In BoundingBox{ -out, height - eps, -out, out, height + eps, out };
inner[]  = Surface In BoundingBox{ -in, eps, -in, in, height - eps, in };
side[]   = Surface{:};
side[]  -= { bottom[], top[], inner[] };

Physical Surface("bottom") = { bottom[] };
Physical Surface("top")    = { top[] };
Physical Surface("side")   = { side[] };
Physical Surface("inner")  = { inner[] };
Physical Volume("body")    = { Volume{:} };

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
