// A pneumatic robot, a finger along x: chambers side by side on a thick sole, one closed cavity through
// the channel that joins them, with slots between them that open to the top; y is up. Under pressure
// the chambers swell, the sole hardly gets longer, and the finger bends down. Our choice: the paper shows
// it (Locking-Proof Tetrahedra, figure 6) but gives no dimensions.
// Unstructured Delaunay tetrahedra of one edge length; or hexahedra, bricks of a grid whose planes are
// those of all walls.

DefineConstant[ size = 0.0035 ]; // edge length, m
DefineConstant[ hexahedra = 0 ]; // 1: hexahedra

DefineConstant[ chambers = 5 ];
wall           = 0.004; // m, around chambers and channel
chamber_length = 0.009; // m, along x
chamber_height = 0.014; // m
chamber_width  = 0.016; // m, along z
channel_height = 0.004; // m
channel_width  = 0.006; // m
slot           = 0.005; // m, along x
sole           = 0.007; // m

pitch  = chamber_length + 2 * wall + slot;
length = chambers * pitch - slot;
height = sole + chamber_height + wall;
width  = chamber_width + 2 * wall;

If (hexahedra)
  // Planes of the grid, and the number of bricks between two of them.
  x[] = { 0 };
  For i In {0:chambers - 1}
    x[] += { i * pitch + wall, i * pitch + wall + chamber_length, i * pitch + 2 * wall + chamber_length };
    If (i < chambers - 1)
      x[] += (i + 1) * pitch;
    EndIf
  EndFor
  y[] = { 0, sole, sole + channel_height, sole + channel_height + wall, sole + chamber_height, height };
  z[] = { -width / 2, -chamber_width / 2, -channel_width / 2,
          channel_width / 2, chamber_width / 2, width / 2 };
  nx      = #x[];
  ny      = #y[];
  nz      = #z[];
  n       = nx * ny * nz;
  step[]  = { 1, nx, nx * ny }; // from one point of the grid to the next one along x, y, z
  at[]    = { x[], y[], z[] };  // all planes,
  first[] = { 0, nx, nx + ny }; // the first one across x, y, z,
  count[] = { nx, ny, nz };     // and how many there are

  // What fills the block behind point p of the grid: 1 body, 2 cavity, 0 nothing. That is behind the
  // last planes, too, so that a block before the first ones is found as one of those.
  fill[] = {};
  For p In {0:step[2] - 1}
    fill[] += 0;
  EndFor
  For p In {0:n - 1}
    i = p % nx;
    j = Floor(p / nx) % ny;
    k = Floor(p / step[2]);
    column  = i % 4; // wall, chamber, wall, slot
    inside  = i < nx - 1 && j < ny - 1 && k < nz - 1 && !(column == 3 && j > 2);
    chamber = column == 1 && j > 0 && j < 4 && k > 0 && k < 4;
    channel = i > 0 && i < nx - 2 && j == 1 && k == 2;
    fill[] += inside ? ((chamber || channel) ? 2 : 1) : 0;
  EndFor

  // Corners, curves along x, y, z and surfaces across x, y, z that the body has.
  has[] = {};
  For p In {0:7 * n - 1}
    has[] += 0;
  EndFor
  For p In {0:n - 1}
    If (fill[step[2] + p] == 1)
      For d In {0:2}
        e = step[(d + 1) % 3];
        f = step[(d + 2) % 3];
        For m In {0:3}
          q = p + (m % 2) * e + Floor(m / 2) * f;
          has[q]               = 1;
          has[q + step[d]]     = 1;
          has[(1 + d) * n + q] = 1;
        EndFor
        has[(4 + d) * n + p]           = 1;
        has[(4 + d) * n + p + step[d]] = 1;
      EndFor
    EndIf
  EndFor

  For p In {0:n - 1}
    If (has[p])
      Point(1 + p) = { x[p % nx], y[Floor(p / nx) % ny], z[Floor(p / step[2])] };
    EndIf
  EndFor
  For d In {0:2}
    For p In {0:n - 1}
      If (has[(1 + d) * n + p])
        plane   = first[d] + Floor(p / step[d]) % count[d];
        c       = 1 + d * n + p;
        Line(c) = { 1 + p, 1 + p + step[d] };
        Transfinite Curve{c} = Max(1, Floor((at[plane + 1] - at[plane]) / size + 0.5)) + 1;
      EndIf
    EndFor
  EndFor
  left[]  = {};
  right[] = {};
  inner[] = {};
  outer[] = {};
  For d In {0:2}
    For p In {0:n - 1}
      If (has[(4 + d) * n + p])
        s = 1 + d * n + p;
        e = (d + 1) % 3;
        f = (d + 2) % 3;
        Curve Loop(s) = { 1 + e * n + p, 1 + f * n + p + step[e], -(1 + e * n + p + step[f]),
                          -(1 + f * n + p) };
        Plane Surface(s) = { s };
        behind = fill[step[2] + p];
        before = fill[step[2] + p - step[d]];
        If (behind == 2 || before == 2)
          inner[] += s;
        ElseIf (d == 0 && p % nx == 0)
          left[] += s;
        ElseIf (d == 0 && p % nx == nx - 1)
          right[] += s;
        ElseIf (behind == 0 || before == 0)
          outer[] += s;
        EndIf
      EndIf
    EndFor
  EndFor
  For p In {0:n - 1}
    If (fill[step[2] + p] == 1)
      Surface Loop(1 + p) = { 1 + p, 1 + p + step[0], 1 + n + p, 1 + n + p + step[1], 1 + 2 * n + p,
                              1 + 2 * n + p + step[2] };
      Volume(1 + p)       = { 1 + p };
    EndIf
  EndFor
  Transfinite Surface{:};
  Recombine Surface{:};
  Transfinite Volume{:};
Else
  SetFactory("OpenCASCADE");
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
EndIf

Physical Surface("left")  = { left[] };
Physical Surface("right") = { right[] };
Physical Surface("outer") = { outer[] };
Physical Surface("inner") = { inner[] };
Physical Volume("body")   = { Volume{:} };

Mesh.Algorithm   = 6; // Frontal-Delaunay on the sides
Mesh.Algorithm3D = 1; // Delaunay inside
