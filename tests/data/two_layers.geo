// Two layers of a unit square each; sizes in units of 10 m.
SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0}; Point(5) = {1, 2, 0}; Point(6) = {0, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Transfinite Curve {1, 2, 3, 4, 5, 6, 7} = 3;
Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Physical Curve("well side", 11) = {4, 7};
Physical Curve("far side", 12) = {2, 5};
Physical Curve("floor", 13) = {1};
Physical Curve("roof", 14) = {6};
Physical Surface("coal", 21) = {1};
Physical Surface("shale", 22) = {2};
