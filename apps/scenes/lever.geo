// A lever with an eye (centre 0, 0) and a round nose (centre 24, 0), in millimetres.
//   gmsh -2 lever.geo
eye = 9; hole = 5; nose = 10; length = 24;
h = 0.025;                             // size where the nose touches

// The sides touch both circles.
c = (nose - eye) / length; s = Sqrt(1 - c * c);
Point(1) = {0, 0, 0};
Point(2) = {-c * eye, s * eye, 0};
Point(3) = {-c * eye, -s * eye, 0};
Point(4) = {-eye, 0, 0};
Point(5) = {length, 0, 0};
Point(6) = {length - c * nose, s * nose, 0};
Point(7) = {length - c * nose, -s * nose, 0};
Point(8) = {length + nose, 0, 0};
Point(9) = {length, -nose, 0};         // the lowest
Point(11) = {hole, 0, 0};
Point(12) = {0, hole, 0};
Point(13) = {-hole, 0, 0};
Point(14) = {0, -hole, 0};
Circle(1) = {2, 1, 4};
Circle(2) = {4, 1, 3};
Line(3) = {3, 7};
Circle(4) = {7, 5, 9};
Circle(5) = {9, 5, 8};
Circle(6) = {8, 5, 6};
Line(7) = {6, 2};
Circle(11) = {11, 1, 12};
Circle(12) = {12, 1, 13};
Circle(13) = {13, 1, 14};
Circle(14) = {14, 1, 11};
Curve Loop(1) = {1 : 7};
Curve Loop(2) = {11 : 14};
Plane Surface(1) = {1, 2};

Physical Surface("lever") = {1};
Physical Curve("nose") = {4, 5};
Physical Curve("hole") = {11 : 14};

// Small elements at the lowest point, larger ones away from it.
Field[1] = Distance;
Field[1].PointsList = {9};
Field[2] = MathEval;
Field[2].F = Sprintf("%g + max(0, 0.2 * (F1 - 0.7))", h);
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = 3;
