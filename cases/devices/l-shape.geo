// The L-shaped body of the literature, in metres.
Point(1) = {0, 1, 0}; Point(2) = {1, 0, 0}; Point(3) = {3, 0, 0}; Point(4) = {3, 1, 0};
Point(5) = {1.5, 1, 0}; Point(6) = {1, 1.5, 0}; Point(7) = {1, 4, 0}; Point(8) = {0, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 1};
Curve Loop(1) = {1 ... 8}; Plane Surface(1) = {1};
Physical Curve("bevel") = {1};
Physical Curve("clamp") = {5};
Physical Curve("0 V") = {6};
Physical Curve("20 V") = {4};
Physical Curve("free") = {2, 3, 7, 8};
Physical Surface("body") = {1};
