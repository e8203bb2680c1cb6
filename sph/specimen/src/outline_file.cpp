// From a mesh to its outline: the sides that only one cell has, joined to closed lines.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/outline.hpp"
#include "plane_mesh.hpp"

namespace fpz::specimen {
namespace detail {

using io::InputError;
using Side = std::array<std::size_t, 2>;

void require_flat(const std::vector<double>& z, double size, const std::string& file) {
  if (z.empty()) return;
  const auto [low, high] = std::minmax_element(z.begin(), z.end());
  if (*high - *low <= 1e-6 * std::max(size, std::abs(*high))) return;
  std::ostringstream s;
  s << file << ": z goes from " << *low << " to " << *high << "; must be the same everywhere: scenes are plane";
  throw InputError(s.str());
}

namespace {

std::string shown(const Point& x) {
  std::ostringstream s;
  s << "[" << x[0] << ", " << x[1] << "]";
  return s.str();
}

/// Sides that one cell has and no other one; of a mesh without cells its lines.
std::vector<Side> sides_of(const PlaneMesh& mesh) {
  if (mesh.cells.empty()) return mesh.lines;
  std::map<Side, int> cells;
  for (const auto& cell : mesh.cells) {
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const std::size_t a = cell[k], b = cell[(k + 1) % cell.size()];
      if (a != b) ++cells[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::vector<Side> sides;
  for (const auto& [side, count] : cells) {
    if (count == 1) sides.push_back(side);
  }
  return sides;
}

/// Closed lines of nodes. Throws where one ends or two touch.
std::vector<std::vector<std::size_t>> loops_of(const std::vector<Side>& sides, const PlaneMesh& mesh,
                                               const std::string& file) {
  std::map<std::size_t, std::vector<std::size_t>> next;
  for (const Side& s : sides) next[s[0]].push_back(s[1]), next[s[1]].push_back(s[0]);
  for (const auto& [node, others] : next) {
    if (others.size() == 2) continue;
    throw InputError(file + ": the outline " + (others.size() == 1 ? "ends" : "touches itself") + " at " +
                     shown(mesh.nodes[node]) + "; must consist of closed lines that do not touch");
  }
  std::vector<std::vector<std::size_t>> loops;
  std::map<std::size_t, bool> done;
  for (const auto& [begin, others] : next) {
    if (done[begin]) continue;
    std::vector<std::size_t>& loop = loops.emplace_back();
    std::size_t before = others[1], at = begin;
    do {
      loop.push_back(at);
      done[at] = true;
      const std::vector<std::size_t>& both = next.at(at);
      const std::size_t after = both[0] == before ? both[1] : both[0];
      before = at;
      at = after;
    } while (at != begin);
  }
  return loops;
}

/// Without the corners on straight pieces, which meshes have many of.
Polygon polygon_of(const std::vector<std::size_t>& loop, const PlaneMesh& mesh) {
  constexpr double straight = 1e-9;  // sine of the turn
  Polygon polygon;
  const std::size_t n = loop.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point &a = mesh.nodes[loop[(k + n - 1) % n]], &b = mesh.nodes[loop[k]], &c = mesh.nodes[loop[(k + 1) % n]];
    const Point in = b - a, out = c - b;
    if (std::abs(cross(in, out)) > straight * in.norm() * out.norm() || in.dot(out) < 0.0) polygon.corners.push_back(b);
  }
  return polygon;
}

Outline outline_of(const PlaneMesh& mesh, const std::string& file) {
  std::vector<Polygon> lines;
  for (const auto& loop : loops_of(sides_of(mesh), mesh, file)) lines.push_back(polygon_of(loop, mesh));
  if (lines.empty()) throw InputError(file + ": has neither triangles, quadrilaterals nor lines");
  const auto size = [](const Polygon& p) { return p.corners.size() < 3 ? 0.0 : area(Shape(p)); };
  std::sort(lines.begin(), lines.end(), [&](const Polygon& a, const Polygon& b) { return size(a) > size(b); });
  if (!(size(lines.front()) > 0.0)) throw InputError(file + ": its outline encloses no area");
  Outline outline{lines.front(), {lines.begin() + 1, lines.end()}};
  for (const Polygon& hole : outline.holes) {
    const Point& at = hole.corners.front();
    const bool in_another = std::any_of(outline.holes.begin(), outline.holes.end(), [&](const Polygon& other) {
      return &other != &hole && contains(Shape(other), at);
    });
    if (contains(Shape(outline.outer), at) && !in_another) continue;
    throw InputError(file + ": the line through " + shown(at) +
                     " is no hole of the largest one; must be one body with holes");
  }
  return outline;
}

}  // namespace
}  // namespace detail

Outline read_outline(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw io::InputError(file.string() + ": cannot be read");
  std::ostringstream all;
  all << in.rdbuf();
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  if (kind == ".msh") return detail::outline_of(detail::read_gmsh(all.str(), file.string()), file.string());
  if (kind == ".stl") return detail::outline_of(detail::read_stl(all.str(), file.string()), file.string());
  throw io::InputError(file.string() + ": outlines are read from .msh (gmsh) and .stl files");
}

}  // namespace fpz::specimen
