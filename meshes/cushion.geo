// A pneumatic robot, a cushion: a square pad, rounded all around, with a closed cavity, rounded too; y is
// up. Our choice: the paper shows it (Locking-Proof Tetrahedra, figure 6) but gives no dimensions.
// Unstructured Delaunay tetrahedra of one edge length.

DefineConstant[ size = 0.008 ]; // edge length, m

width        = 0.080; // m, along x and z
height       = 0.032; // m
wall         = 0.010; // m
round        = 0.012; // m, radius of the edges
cavity_round = 0.004; // m, of the cavity's edges

SetFactory("OpenCASCADE");
Box(1) = { -width / 2, 0, -width / 2, width, height, width };
Fillet{ 1 }{ 1:12 }{ round }
inside  = width - 2 * wall;
c       = newc;
Box(2)  = { -inside / 2, wall, -inside / 2, inside, height - 2 * wall, inside };
Fillet{ 2 }{ c:c + 11 }{ cavity_round }
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
MeshSize{ PointsOf{ Volume{3}; } } = size;

// The flat part of the lower face, which stands on the ground; the cavity; all the rest.
eps      = wall / 10;
bottom[] = Surface In BoundingBox{ -width, -eps, -width, width, eps, width };
inner[]  = Surface In BoundingBox{ -inside / 2 - eps, wall - eps, -inside / 2 - eps,
                                   inside / 2 + eps, height - wall + eps, inside / 2 + eps };
outer[]  = Surface{:};
outer[] -= { bottom[], inner[] };

Physical Surface("bottom") = { bottom[] };
Physical Surface("outer")  = { outer[] };
Physical Surface("inner")  = { inner[] };
Physical Volume("body")    = { 3 };

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
