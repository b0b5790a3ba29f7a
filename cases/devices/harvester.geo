// A strip of 40 mm by 1 mm in two layers; the last 2 mm of its lower face may hit a stop.
l = 40e-3; h = 0.5e-3; tip = 2e-3; lc = 0.5e-3;
Point(1) = {0, -h, 0, lc}; Point(2) = {l - tip, -h, 0, lc}; Point(3) = {l, -h, 0, lc};
Point(4) = {l, 0, 0, lc}; Point(5) = {l, h, 0, lc}; Point(6) = {0, h, 0, lc}; Point(7) = {0, 0, 0, lc};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
Line(6) = {6, 7}; Line(7) = {7, 1}; Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, -8, 7}; Plane Surface(1) = {1};
Curve Loop(2) = {8, 4, 5, 6}; Plane Surface(2) = {2};
Physical Curve("clamp") = {6, 7};
Physical Curve("lower face") = {1, 2};
Physical Curve("upper face") = {5};
Physical Curve("pad") = {2};
Physical Curve("end") = {3, 4};
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
