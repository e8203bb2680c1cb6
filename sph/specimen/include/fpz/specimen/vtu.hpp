// Point clouds with data as VTK files: written as .vtu (raw appended binary), read from .vtu and legacy .vtk.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fpz::specimen {

/// Values of all points, point after point.
struct PointData {
  std::string name;
  int components = 1;
  std::vector<double> values;
  bool single = true;  ///< written with 32 bits
};

struct PointCloud {
  double time = 0.0;
  std::vector<double> points;  ///< x, y, z of every point
  std::vector<PointData> data;

  [[nodiscard]] std::size_t size() const { return points.size() / 3; }
  [[nodiscard]] const PointData* find(const std::string& name) const;
};

/// Writes an unstructured grid of vertices. Replaces a file of that name when it is complete. Throws io::OutputError.
void write_vtu(const std::filesystem::path& file, const PointCloud& cloud);

/// Reads the points and point data of a .vtu file (ascii, base64 or raw, compressed by zlib or not) or a legacy .vtk
/// file (ASCII or binary). Throws io::InputError.
[[nodiscard]] PointCloud read_vtk(const std::filesystem::path& file);

/// A series of files with their times, paths relative to the collection.
struct Frame {
  double time = 0.0;
  std::string file;
};
void write_pvd(const std::filesystem::path& file, const std::vector<Frame>& frames);
[[nodiscard]] std::vector<Frame> read_pvd(const std::filesystem::path& file);

}  // namespace fpz::specimen
