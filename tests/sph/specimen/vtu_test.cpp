#include "fpz/specimen/vtu.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/specimen.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

fs::path folder() {
  static const fpz::test::TemporaryFolder all;
  return all.path();
}

PointCloud cloud() {
  PointCloud c;
  c.time = 1.25e-3;
  c.points = {0.0, 0.1, 0.0, 1.0, 1.0 / 3.0, 0.0, -2.0, 5e-7, 0.0};
  c.data.push_back({"damage", 1, {0.0, 0.5, 1.0}, true});
  c.data.push_back({"displacement", 3, {1e-9, 2e-9, 0.0, 1.0 / 7.0, 0.0, 0.0, 3.0, 4.0, 5.0}, false});
  return c;
}

TEST(Vtu, ReadsBackWhatWasWritten) {
  const fs::path file = folder() / "a.vtu";
  write_vtu(file, cloud());
  const PointCloud back = read_vtk(file);
  EXPECT_EQ(back.time, cloud().time);
  EXPECT_EQ(back.points, cloud().points);
  ASSERT_NE(back.find("damage"), nullptr);
  EXPECT_EQ(back.find("damage")->values, cloud().data[0].values);
  EXPECT_EQ(back.find("displacement")->values, cloud().data[1].values);
  EXPECT_EQ(back.find("displacement")->components, 3);
}

TEST(Vtu, BrokenFilesAreRefused) {
  const fs::path file = folder() / "b.vtu";
  write_vtu(file, cloud());
  fs::resize_file(file, fs::file_size(file) - 120);
  EXPECT_THROW((void)read_vtk(file), fpz::io::InputError);
  std::ofstream(file) << "hello";
  EXPECT_THROW((void)read_vtk(file), fpz::io::InputError);
  EXPECT_THROW((void)read_vtk(folder() / "missing.vtu"), fpz::io::InputError);
}

TEST(Vtu, CollectionsKeepTimesAndFiles) {
  const fs::path file = folder() / "c.pvd";
  write_pvd(file, {{0.0, "frames/frame_00000.vtu"}, {1e-3, "frames/frame_00001.vtu"}});
  const auto frames = read_pvd(file);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].time, 1e-3);
  EXPECT_EQ(frames[1].file, "frames/frame_00001.vtu");
}

TEST(ParticleFile, CsvVtuAndLegacyVtk) {
  const fs::path csv = folder() / "p.csv";
  std::ofstream(csv) << "x,y,volume,group\n0,0,1e-6,-1\n0.001,0,2e-6,0\n";
  const fpz::sph::Arrangement<2> a = read_particles(csv, 1e-3);
  ASSERT_EQ(a.size(), 2u);
  EXPECT_EQ(a.volume[1], 2e-6);
  EXPECT_EQ(a.group[1], 0);

  fpz::io::CsvOptions notation;
  notation.separator = fpz::io::CsvSeparator::semicolon;
  notation.decimal = fpz::io::DecimalMark::comma;
  std::ofstream(csv) << "x;y;volume\n0;0;1\n1,234;0;2\n";  // 1.234 or 1234
  EXPECT_THROW((void)read_particles(csv, 1e-3), fpz::io::InputError);
  EXPECT_EQ(read_particles(csv, 1e-3, notation).position[1], Point(1.234, 0));

  const fs::path vtk = folder() / "p.vtk";
  std::ofstream(vtk)
      << "# vtk DataFile Version 3.0\nparticles\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n0 0 0\n1 2 0\n"
         "POINT_DATA 2\nSCALARS volume double 1\nLOOKUP_TABLE default\n0.5 0.25\n";
  const fpz::sph::Arrangement<2> b = read_particles(vtk, 0.5);
  ASSERT_EQ(b.size(), 2u);
  EXPECT_EQ(b.volume[1], 0.25);
  EXPECT_EQ(b.position[1], Point(1, 2));
  EXPECT_EQ(b.group[0], -1);

  const fs::path vtu = folder() / "p.vtu";
  write_vtu(vtu, cloud());
  EXPECT_EQ(read_particles(vtu, 0.1).volume[0], 0.1 * 0.1);

  std::ofstream(csv) << "x,y,volume\n0,0,-1\n";
  EXPECT_THROW((void)read_particles(csv, 1e-3), fpz::io::InputError);
}

}  // namespace
