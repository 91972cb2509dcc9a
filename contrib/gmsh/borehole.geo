// A quarter of a square block of rock, 10 m wide, around a borehole of 0.2 m in diameter, with a
// damaged zone of 0.3 m radius. Lengths in metres.
//   gmsh -2 -format msh41 borehole.geo
r = 0.1; z = 0.3; L = 5; s = Sqrt(0.5);
Point(1) = {0, 0, 0};
Point(2) = {r, 0, 0};  Point(3) = {r*s, r*s, 0};  Point(4) = {0, r, 0};
Point(5) = {z, 0, 0};  Point(6) = {z*s, z*s, 0};  Point(7) = {0, z, 0};
Point(8) = {L, 0, 0};  Point(9) = {L, L, 0};      Point(10) = {0, L, 0};

Circle(1) = {2, 1, 3};  Circle(2) = {3, 1, 4};
Circle(3) = {5, 1, 6};  Circle(4) = {6, 1, 7};
Line(5) = {8, 9};       Line(6) = {9, 10};
Line(7) = {2, 5};       Line(8) = {3, 6};   Line(9) = {4, 7};
Line(10) = {5, 8};      Line(11) = {6, 9};  Line(12) = {7, 10};

Curve Loop(1) = {7, 3, -8, -1};    Plane Surface(1) = {1};
Curve Loop(2) = {8, 4, -9, -2};    Plane Surface(2) = {2};
Curve Loop(3) = {10, 5, -11, -3};  Plane Surface(3) = {3};
Curve Loop(4) = {11, 6, -12, -4};  Plane Surface(4) = {4};

Transfinite Curve {1, 2, 3, 4, 5, 6} = 13;
Transfinite Curve {7, 8, 9} = 9 Using Progression 1.1;
Transfinite Curve {10, 11, 12} = 21 Using Progression 1.18;
Transfinite Surface {1, 2, 3, 4};
Recombine Surface {1, 2, 3, 4};

Physical Curve("borehole", 1) = {1, 2};
Physical Curve("symmetry x", 2) = {9, 12};
Physical Curve("symmetry y", 3) = {7, 10};
Physical Curve("far", 4) = {5, 6};
Physical Surface("damaged zone", 1) = {1, 2};
Physical Surface("rock", 2) = {3, 4};
