// A pneumatic robot, a finger along x: chambers side by side on a thick sole, one closed cavity through
// the channel that joins them, with slots between them that open to the top; y is up. Under pressure
// the chambers swell, the sole hardly gets longer, and the finger bends down. Our choice: the paper shows
// it (Locking-Proof Tetrahedra, figure 6) but gives no dimensions.
// Unstructured Delaunay tetrahedra of one edge length.

DefineConstant[ size = 0.0035 ]; // edge length, m

DefineConstant[ chambers = 5 ];
wall           = 0.004; // m, around chambers and channel
chamber_length = 0.009; // m, along x
chamber_height = 0.014; // m
chamber_width  = 0.016; // m, along z
channel_height = 0.004; // m
channel_width  = 0.006; // m
slot           = 0.005; // m, along x
sole           = 0.007; // m

SetFactory("OpenCASCADE");
pitch  = chamber_length + 2 * wall + slot;
length = chambers * pitch - slot;
height = sole + chamber_height + wall;
width  = chamber_width + 2 * wall;

Box(1) = { 0, 0, -width / 2, length, height, width };
cavity[] = {};
slots[]  = {};
For i In {0:chambers - 1}
  v = newv;
  Box(v) = { i * pitch + wall, sole, -chamber_width / 2,
             chamber_length, chamber_height, chamber_width };
  cavity[] += v;
  If (i > 0)
    v = newv;
    Box(v) = { i * pitch - slot, sole + channel_height + wall, -width / 2, slot, height, width };
    slots[] += v;
  EndIf
EndFor
v = newv;
Box(v) = { wall, sole, -channel_width / 2, length - 2 * wall, channel_height, channel_width };
BooleanDifference(100) = { Volume{1}; Delete; }{ Volume{ cavity[], slots[], v }; Delete; };
MeshSize{ PointsOf{ Volume{100}; } } = size;

// The cavity's surface is what touches no side of the finger.
eps     = wall / 10;
left[]  = Surface In BoundingBox{ -eps, -eps, -width, eps, height + eps, width };
right[] = Surface In BoundingBox{ length - eps, -eps, -width, length + eps, height + eps, width };
inner[] = Surface In BoundingBox{ eps, eps, eps - width / 2,
                                  length - eps, height - eps, width / 2 - eps };
outer[]  = Surface{:};
outer[] -= { left[], right[], inner[] };

Physical Surface("left")  = { left[] };
Physical Surface("right") = { right[] };
Physical Surface("outer") = { outer[] };
Physical Surface("inner") = { inner[] };
Physical Volume("body")   = { 100 };

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
