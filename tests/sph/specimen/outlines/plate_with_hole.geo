// 100 mm x 60 mm plate with a round hole, in mm
SetFactory("Built-in");
Point(1) = {0, 0, 0, 30}; Point(2) = {100, 0, 0, 30}; Point(3) = {100, 60, 0, 30}; Point(4) = {0, 60, 0, 30};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(5) = {50, 30, 0, 8}; Point(6) = {60, 30, 0, 8}; Point(7) = {50, 40, 0, 8}; Point(8) = {40, 30, 0, 8}; Point(9) = {50, 20, 0, 8};
Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 8}; Circle(7) = {8, 5, 9}; Circle(8) = {9, 5, 6};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};
