// Outlines of bodies from the files of mesh and drawing programs.
#pragma once

#include <filesystem>
#include <vector>

#include "fpz/specimen/geometry.hpp"

namespace fpz::specimen {

/// Closed lines that do not repeat their first corner: round about the body, and round its holes.
struct Outline {
  Polygon outer;
  std::vector<Polygon> holes;
};

/// The outline of the plane mesh in a gmsh file (.msh, versions 2 and 4, ASCII) or of the flat surface in an .stl file
/// (ASCII or binary), in the units of the file. Without elements the lines of a gmsh file are the outline. Throws
/// io::InputError with what is wrong: not flat, several bodies, open lines, no such format.
[[nodiscard]] Outline read_outline(const std::filesystem::path& file);

}  // namespace fpz::specimen
