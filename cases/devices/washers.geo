// A quarter of a stack of washers, 5 and 10 mm in radius: ceramic, steel, ceramic, 2 mm, 1 mm, 2 mm high.
lc = 2.5e-3; r = 5e-3; R = 10e-3;
Point(1) = {0, 0, 0, lc}; Point(2) = {r, 0, 0, lc}; Point(3) = {R, 0, 0, lc};
Point(4) = {0, R, 0, lc}; Point(5) = {0, r, 0, lc};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
a[] = Extrude {0, 0, 2e-3} { Surface{1}; Layers{2}; };
b[] = Extrude {0, 0, 1e-3} { Surface{a[0]}; Layers{1}; };
c[] = Extrude {0, 0, 2e-3} { Surface{b[0]}; Layers{2}; };
Physical Surface("foot") = {1};
Physical Surface("head") = {c[0]};
Physical Surface("y = 0") = {a[2], b[2], c[2]};
Physical Surface("x = 0") = {a[4], b[4], c[4]};
Physical Surface("rim of the shim") = {b[3]};
Physical Surface("walls") = {a[3], a[5], b[5], c[3], c[5]};
Physical Volume("lower washer") = {a[1]};
Physical Volume("shim") = {b[1]};
Physical Volume("upper washer") = {c[1]};
