// Outlines from files that gmsh has written (plate_with_hole.geo: 100 by 60 mm with a round hole of 10 mm).
#include "fpz/specimen/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/specimen.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

const fs::path folder = fs::path(FPZ_SOURCE_DIR) / "tests/sph/specimen/outlines";

std::string complaint(const std::string& file) {
  try {
    (void)read_outline(file);
  } catch (const fpz::io::InputError& e) {
    return e.what();
  }
  return "read";
}

/// Four sides, whatever points lie on them; a hole of equal sides with its corners on the circle.
void expect_plate_with_hole(const Outline& o) {
  EXPECT_EQ(o.outer.corners.size(), 4u);
  EXPECT_NEAR(area(Shape(o.outer)), 6000.0, 1e-3);
  ASSERT_EQ(o.holes.size(), 1u);
  const std::vector<Point>& hole = o.holes[0].corners;
  ASSERT_GE(hole.size(), 8u);
  for (const Point& x : hole) EXPECT_NEAR((x - Point(50.0, 30.0)).norm(), 10.0, 1e-4);
  const double n = static_cast<double>(hole.size());
  EXPECT_NEAR(area(Shape(o.holes[0])), 0.5 * n * 100.0 * std::sin(2.0 * M_PI / n), 1e-2);
}

TEST(Outline, OfFilesOfGmsh) {
  for (const char* name :
       {"version_2.msh", "version_4.msh", "second_order.msh", "lines_only.msh", "ascii.stl", "binary.stl"}) {
    SCOPED_TRACE(name);
    expect_plate_with_hole(read_outline(folder / name));
  }
}

TEST(Outline, WhatCannotBeReadIsNamed) {
  const auto expect = [](const fs::path& file, const std::string& text) {
    EXPECT_NE(complaint(file.string()).find(text), std::string::npos) << complaint(file.string());
  };
  expect(folder / "binary.msh", "is binary; must be ASCII");
  expect(folder / "volume.msh", "has elements of type 4; must have lines, triangles and quadrilaterals only");
  expect(folder / "plate_with_hole.geo", "outlines are read from .msh (gmsh) and .stl files");
  expect(folder / "absent.msh", "cannot be read");
  const fpz::test::TemporaryFolder own;
  const auto written = [&](const std::string& name, const std::string& text) { return own.write(name, text); };
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n";
  expect(written("open.msh", head + nodes + "$Elements\n2\n1 1 0 1 2\n2 1 0 2 3\n$EndElements\n"),
         "the outline ends at [0, 0]");
  expect(written("early.msh", head + "$Nodes\n4\n1 0 0 0\n2 1"), "ends early, or has no number");
  expect(written("unknown.msh", head + nodes + "$Elements\n1\n1 2 0 1 2 9\n$EndElements\n"), "has node 9");
  expect(written("tetrahedron.msh", head + nodes + "$Elements\n1\n1 4 0 1 2 3 4\n$EndElements\n"),
         "has elements of type 4");
  expect(written("inclined.stl", "solid x\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n"), "z goes from 0 to 1");
  expect(written("nothing.msh", head + nodes), "has neither triangles, quadrilaterals nor lines");
  expect(written("old.msh", "$MeshFormat\n1 0 8\n$EndMeshFormat\n"), "must be version 2.2 or 4.1");
  expect(written("text.msh", "x y\n0 0\n"), "has no $Nodes");
  expect(written("touching.msh", head + "$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 2 1 0\n5 2 2 0\n$EndNodes\n"
                                        "$Elements\n2\n1 2 0 1 2 3\n2 2 0 3 4 5\n$EndElements\n"),
         "touches itself at [1, 1]");
  expect(written("bad.stl", "a drawing"), "begins with neither");
  expect(written("half.stl", "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\n"), "ends within a triangle");
}

/// The plate in a scene: in metres, its hole a hole of the body; the scene of the output reads the same from elsewhere.
TEST(Outline, AsTheShapeOfAScene) {
  const std::string file = (folder / "version_4.msh").string();
  const std::vector<std::string> set = {R"(shape={"type": "outline", "file": ")" + file + R"(", "scale": 1e-3})",
                                        "spacing=0.002", "notches=[]",
                                        R"(boundaries=[{"name": "top", "at": [0.05, 0.06], "direction": [0, 1],
                                            "width": 0.02, "velocity": {"y": -0.01}},
                                          {"name": "bottom", "at": [0.05, 0], "direction": [0, -1], "width": 0.02,
                                           "velocity": {"y": 0}}])",
                                        R"(gauges={"load": {"force_on": "top", "direction": [0, -1]},
                                          "deflection": {"displacement_of": "top", "direction": [0, -1]}})"};
  const Scene scene = read_scene(fs::path(FPZ_DATA_DIR) / "scenes/beam_3pb.json", set);
  ASSERT_EQ(scene.body.holes.size(), 1u);
  const Specimen s = make_specimen(scene);
  EXPECT_NEAR(s.area, area(scene.body), 1e-9);
  EXPECT_NEAR(s.area, 6000e-6 - 400e-6 * std::sin(M_PI / 4.0), 1e-8);  // the hole has eight corners
  const Scene again = parse_scene(scene.text, "/elsewhere/scene.json");
  EXPECT_EQ(area(again.body), area(scene.body));
  try {
    std::vector<std::string> as_hole = set;
    as_hole.push_back(R"(holes=[{"type": "outline", "file": ")" + file + R"(", "scale": 1e-4}])");
    (void)read_scene(fs::path(FPZ_DATA_DIR) / "scenes/beam_3pb.json", as_hole);
    ADD_FAILURE() << "a hole with holes";
  } catch (const fpz::io::InputError& e) {
    EXPECT_NE(std::string(e.what()).find("has holes, which only \"shape\" may have"), std::string::npos) << e.what();
  }
}

}  // namespace
