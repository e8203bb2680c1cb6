// A mesh of the plane as files have it.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen::detail {

struct PlaneMesh {
  std::vector<Point> nodes;
  std::vector<std::vector<std::size_t>> cells;    ///< corners of triangles and quadrilaterals, round about
  std::vector<std::array<std::size_t, 2>> lines;  ///< of the mesh, not necessarily sides of cells
};

/// Both throw io::InputError. `text` is the content of the file.
[[nodiscard]] PlaneMesh read_gmsh(const std::string& text, const std::string& file);
[[nodiscard]] PlaneMesh read_stl(const std::string& text, const std::string& file);

/// Throws unless all heights are one, within a millionth of the size.
void require_flat(const std::vector<double>& z, double size, const std::string& file);

}  // namespace fpz::specimen::detail
