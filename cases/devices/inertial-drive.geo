// Half of a rod of 40 mm by 10 mm about its middle plane y = 0: a foot, a piezoelectric part, a mass.
foot = 10e-3; piezo = 10e-3; mass = 20e-3; h = 5e-3;
nf = 4; np = 4; nm = 8; nh = 2;   // intervals along x in each part, along y
Point(1) = {0, 0, 0}; Point(2) = {foot, 0, 0}; Point(3) = {foot + piezo, 0, 0}; Point(4) = {foot + piezo + mass, 0, 0};
Point(5) = {foot + piezo + mass, h, 0}; Point(6) = {foot + piezo, h, 0}; Point(7) = {foot, h, 0}; Point(8) = {0, h, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 7};
Line(7) = {7, 8}; Line(8) = {8, 1}; Line(9) = {2, 7}; Line(10) = {3, 6};
Curve Loop(1) = {1, 9, 7, 8}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 10, 6, -9}; Plane Surface(2) = {2};
Curve Loop(3) = {3, 4, 5, -10}; Plane Surface(3) = {3};
Transfinite Curve {1, 7} = nf + 1; Transfinite Curve {2, 6} = np + 1; Transfinite Curve {3, 5} = nm + 1;
Transfinite Curve {4, 8, 9, 10} = nh + 1;
Transfinite Surface {1}; Transfinite Surface {2}; Transfinite Surface {3};
Physical Curve("middle") = {1, 2, 3};
Physical Curve("sole") = {7};
Physical Curve("sides") = {5, 6};
Physical Curve("foot end") = {8};
Physical Curve("mass end") = {4};
Physical Surface("foot") = {1};
Physical Surface("piezo") = {2};
Physical Surface("mass") = {3};
