// Flat surfaces of triangles from .stl files, ASCII or binary.
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "plane_mesh.hpp"

namespace fpz::specimen::detail {
namespace {

using io::InputError;
using Corner = std::array<double, 3>;

constexpr std::size_t header = 84, facet = 50;  // bytes

/// Little-endian, whatever the machine.
std::uint32_t word_at(const std::string& text, std::size_t at) {
  std::uint32_t w = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    w |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[at + k])) << (8 * k);
  }
  return w;
}

bool is_binary(const std::string& text) {
  return text.size() >= header && text.size() == header + facet * word_at(text, header - 4);
}

/// Three for each triangle.
std::vector<Corner> corners_of_binary(const std::string& text) {
  std::vector<Corner> all;
  for (std::size_t at = header; at < text.size(); at += facet) {
    for (std::size_t k = 0; k < 3; ++k) {
      Corner c;
      for (std::size_t d = 0; d < 3; ++d) c[d] = std::bit_cast<float>(word_at(text, at + 12 * (k + 1) + 4 * d));
      all.push_back(c);
    }
  }
  return all;
}

std::vector<Corner> corners_of_text(const std::string& text, const std::string& file) {
  std::vector<Corner> all;
  std::istringstream in(text);
  std::string word;
  if (!(in >> word) || word != "solid") throw InputError(file + ": begins with neither \"solid\" nor a binary header");
  while (in >> word) {
    if (word != "vertex") continue;
    Corner c;
    if (!(in >> c[0] >> c[1] >> c[2])) {
      throw InputError(file + ": vertex " + std::to_string(all.size()) + " has no three coordinates");
    }
    all.push_back(c);
  }
  if (all.size() % 3 != 0) throw InputError(file + ": ends within a triangle");
  return all;
}

}  // namespace

/// Corners at one place become one node: the files know triangles only.
PlaneMesh read_stl(const std::string& text, const std::string& file) {
  constexpr double same = 1e-6;  // of the size; the numbers have seven digits
  const std::vector<Corner> all = is_binary(text) ? corners_of_binary(text) : corners_of_text(text, file);
  double size = 0.0;
  std::vector<double> z;
  for (const Corner& c : all) {
    if (!std::isfinite(c[0]) || !std::isfinite(c[1])) throw InputError(file + ": a coordinate is no number");
    size = std::max({size, std::abs(c[0]), std::abs(c[1])});
    z.push_back(c[2]);
  }
  require_flat(z, size, file);
  PlaneMesh mesh;
  std::map<std::array<long long, 2>, std::size_t> known;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto on_grid = [&](double x) { return std::llround(x / (same * size)); };
    const auto [at, is_new] = known.emplace(std::array{on_grid(all[k][0]), on_grid(all[k][1])}, mesh.nodes.size());
    if (is_new) mesh.nodes.emplace_back(all[k][0], all[k][1]);
    if (k % 3 == 0) mesh.cells.emplace_back();
    mesh.cells.back().push_back(at->second);
  }
  return mesh;
}

}  // namespace fpz::specimen::detail
