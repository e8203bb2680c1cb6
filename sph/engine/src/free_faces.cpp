#include "free_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "fpz/sph/kernel.hpp"
#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {

using Vec2 = Vec<double, 2>;

// In spacings:
constexpr double near_by = 1.6;  // of the neighbours that tell whether a particle lies on the surface
constexpr double margin = 0.5;   // gap up to which faces get a point
constexpr double deepest = 1.0;  // overlap up to which a face is on this side of another
constexpr double sideways =
    1.1;                       // from a face to the place opposite another: beside an edge, which has none, a spacing
constexpr double moved = 0.2;  // of each of two faces between searches: together less than the margin

Vec2 left_of(const Vec2& v) { return {-v[1], v[0]}; }
Vec2 right_of(const Vec2& v) { return {v[1], -v[0]}; }
Vec2 start_of(const RunData<2>& run, std::size_t i) { return {run.particles.start[0][i], run.particles.start[1][i]}; }
Vec2 displacement(const RunData<2>& run, std::size_t i) {
  return Vec2(run.particles.position[0][i], run.particles.position[1][i]) - start_of(run, i);
}
double size_of(const RunData<2>& run, std::size_t i) { return std::sqrt(run.particles.volume[i]); }
double friction_of(const RunData<2>& run, std::size_t i) {
  return std::tan(degree * run.materials.parameters(i).friction_angle_deg);
}

/// Where a particle has nothing before it.
struct OpenSide {
  Vec2 normal;   ///< unit, outward: from where its nearest neighbours are to where they lack
  bool is_edge;  ///< nothing is beside it either
};

/// On a straight surface three neighbours lack of the eight of a lattice, at a corner five.
std::optional<OpenSide> open_side(const RunData<2>& run, const std::vector<int>& list, std::size_t i) {
  constexpr double surface = 1.2;  // length of the sum of unit vectors: 2.4 on a surface, 1 in a concave corner
  constexpr double before = 0.7, beside = -0.4;  // cosines
  std::vector<Vec2> unit;
  Vec2 sum = Vec2::Zero();
  for (const int j : list) {
    const Vec2 r = start_of(run, static_cast<std::size_t>(j)) - start_of(run, i);
    if (r.norm() > near_by * run.setup.arrangement.spacing) continue;
    unit.push_back(r.normalized());
    sum -= unit.back();
  }
  const bool is_open = unit.size() == 1 || sum.norm() > surface;
  if (unit.empty() || !is_open) return std::nullopt;
  const Vec2 normal = sum.normalized();
  double most = -1.0;
  for (const Vec2& r : unit) most = std::max(most, r.dot(normal));
  return most > before ? std::nullopt : std::optional(OpenSide{normal, most < beside});
}

/// Which of some particles lie on which sides of points.
class Seats {
 public:
  Seats(const std::vector<ContactPoint<2>>& points, const std::vector<bool>& wanted) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      for (std::size_t s = 0; s < 2; ++s) {
        for (const std::size_t i : points[k].side[s].particle) {
          if (wanted[i]) seats_.push_back({i, k, s});
        }
      }
    }
    std::sort(seats_.begin(), seats_.end());
  }
  /// Whether two particles are on the two sides of one point.
  [[nodiscard]] bool face_each_other(std::size_t i, std::size_t j) const {
    for (auto at = std::lower_bound(seats_.begin(), seats_.end(), Seat{i, 0, 0}); at != seats_.end() && (*at)[0] == i;
         ++at) {
      if (std::binary_search(seats_.begin(), seats_.end(), Seat{j, (*at)[1], 1 - (*at)[2]})) return true;
    }
    return false;
  }

 private:
  using Seat = std::array<std::size_t, 3>;  // particle, point, side
  std::vector<Seat> seats_;
};

}  // namespace

template <int Dim>
FreeFaces<Dim>::FreeFaces(const RunData<Dim>& run, const NeighbourLists& lists) : run_(run), lists_(lists) {
  describe_surface();
  find_all();
}

/// The straight pieces of the outline, and both faces of the cuts.
template <int Dim>
void FreeFaces<Dim>::describe_surface() {
  const Arrangement<Dim>& a = run_.setup.arrangement;
  for (const auto& line : a.surface) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) lines_.push_back({line[k], line[k + 1]});
  }
  for (const Cut<Dim>& cut : a.cuts) {
    const Vector half = 0.5 * cut.width * left_of(cut.corner[1] - cut.corner[0]).normalized();
    lines_.push_back({cut.corner[0] + half, cut.corner[1] + half});
    lines_.push_back({cut.corner[0] - half, cut.corner[1] - half});
  }
}

template <int Dim>
void FreeFaces<Dim>::find_all() {
  faces_.clear();
  for (std::size_t i = 0; i < run_.particles.count; ++i) {
    if (auto face = face_of(i)) faces_.push_back(std::move(*face));
  }
  searched_at_.assign(faces_.size(), Vector::Zero());
  changed_ = true;
}

/// The face before a particle, if it has one. Pieces that touch the body by cuts only (platens) have none.
template <int Dim>
std::optional<FreeFace<Dim>> FreeFaces<Dim>::face_of(std::size_t particle) const {
  if (run_.piece[particle] != 0) return std::nullopt;
  const auto open = open_side(run_, lists_[particle], particle);
  if (!open) return std::nullopt;
  const Vector place = start_of(run_, particle) + 0.5 * size_of(run_, particle) * open->normal;
  FreeFace<Dim> face{particle, place, open->normal, open->is_edge, {}};
  if (!face.is_edge) put_on_surface(face);
  face.side = side_at(particle, face.at, face.normal);
  return face;
}

/// Moves a face to the described surface, where that runs along it.
template <int Dim>
void FreeFaces<Dim>::put_on_surface(FreeFace<Dim>& face) const {
  constexpr double alike = 0.8;  // cosine
  const Vector x = start_of(run_, face.particle), seen = face.normal;
  double nearest = size_of(run_, face.particle);
  for (const Line& line : lines_) {
    const Vector d = line.to - line.from;
    const Vector foot = line.from + std::clamp((x - line.from).dot(d) / d.squaredNorm(), 0.0, 1.0) * d;
    const double distance = (foot - x).norm();
    Vector normal = left_of(d).normalized();
    if (normal.dot(seen) < 0.0) normal = -normal;
    if (distance >= nearest || normal.dot(seen) < alike || (foot - x).dot(normal) < 0.0) continue;
    nearest = distance;
    face.at = foot;
    face.normal = normal;
  }
}

/// What a place in front of a particle moves with: the particle and what is bonded to it, behind the place. The
/// particle alone where these do not determine a linear field.
template <int Dim>
FaceSide FreeFaces<Dim>::side_at(std::size_t particle, const Vector& at, const Vector& normal) const {
  std::vector<std::size_t> particles = {particle};
  for (const int j : lists_[particle]) {
    const auto k = static_cast<std::size_t>(j);
    const Vector r = start_of(run_, k) - at;
    if (r.dot(normal) < 0.0 && r.norm() < face_reach * run_.setup.arrangement.spacing) particles.push_back(k);
  }
  return fitted_side(run_, at, left_of(normal), particles).value_or(FaceSide{{particle}, {1.0}, {0.0}});
}

template <int Dim>
void FreeFaces<Dim>::refit(const std::vector<ReleasedBond<Dim>>& released) {
  std::vector<std::size_t> touched;
  for (const ReleasedBond<Dim>& bond : released) touched.push_back(bond.from), touched.push_back(bond.to);
  sort_unique(touched);
  const auto is_touched = [&](const FreeFace<Dim>& face) {
    return std::binary_search(touched.begin(), touched.end(), face.particle);
  };
  std::erase_if(faces_, is_touched);
  for (const std::size_t i : touched) {
    if (auto face = face_of(i)) faces_.push_back(std::move(*face));
  }
  std::sort(faces_.begin(), faces_.end(), [](const auto& a, const auto& b) { return a.particle < b.particle; });
  searched_at_.assign(faces_.size(), Vector::Zero());
  changed_ = true;
}

template <int Dim>
bool FreeFaces<Dim>::search_is_due(double part) const {
  if (changed_) return true;
  const double most = std::pow(part * moved * run_.setup.arrangement.spacing, 2);
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if ((displacement(run_, faces_[k].particle) - searched_at_[k]).squaredNorm() > most) return true;
  }
  return false;
}

template <int Dim>
typename FreeFaces<Dim>::Present FreeFaces<Dim>::present(const FreeFace<Dim>& face) const {
  Present now{face.at, left_of(face.normal)};
  for (std::size_t k = 0; k < face.side.particle.size(); ++k) {
    const Vector u = displacement(run_, face.side.particle[k]);
    now.at += face.side.weight[k] * u;
    now.normal += face.side.slope[k] * u;
  }
  now.normal = right_of(now.normal).normalized();
  return now;
}

/// The point between a face and the place of another that lies `along` (m) to the left of its own. It has the normal of
/// the other one and turns with it: a corner on a flat face is pressed away from that, and slides along it.
template <int Dim>
ContactPoint<Dim> FreeFaces<Dim>::joined(const FreeFace<Dim>& face, const FreeFace<Dim>& other, double along) const {
  ContactPoint<Dim> point;
  const Vector place = other.at + along * left_of(other.normal);
  point.of_face = true;
  point.normal = -other.normal;
  point.side = {face.side, side_at(other.particle, place, other.normal)};
  for (double& s : point.side[0].slope) s = 0.0;
  for (double& s : point.side[1].slope) s = -s;  // from side 0 its left is the right
  point.at_start = place - face.at;
  const double friction = std::min(friction_of(run_, face.particle), friction_of(run_, other.particle));
  point.law = contact_law(run_, point.side, 0.5 * size_of(run_, face.particle), friction);
  return point;
}

template <int Dim>
std::vector<ContactPoint<Dim>> FreeFaces<Dim>::search(const std::vector<ContactPoint<Dim>>& facing) {
  const double spacing = run_.setup.arrangement.spacing, cell = 1.5 * spacing;
  const double bonded = kernel_support * run_.h;
  std::vector<Present> now;
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells;
  const auto cell_of = [&](const Vector& x) {
    return std::pair(static_cast<long>(std::floor(x[0] / cell)), static_cast<long>(std::floor(x[1] / cell)));
  };
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    now.push_back(present(faces_[k]));
    if (now[k].at.allFinite()) cells[cell_of(now[k].at)].push_back(k);
    searched_at_[k] = displacement(run_, faces_[k].particle);
  }
  changed_ = false;

  struct Partner {
    std::size_t face, other;
    double along;
  };
  std::vector<Partner> partners;
  for (std::size_t k = 0; k < faces_.size(); ++k) {
    if (!now[k].at.allFinite()) continue;
    constexpr double opposed = -0.5;  // cosine
    const std::size_t none = faces_.size();
    Partner best{k, none, 0.0};
    double nearest = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::size_t m) {
      const Vector r = now[m].at - now[k].at;
      if (faces_[m].is_edge || r.norm() >= nearest || now[k].normal.dot(now[m].normal) > opposed) return;
      const double gap = -r.dot(now[m].normal), along = -r.dot(left_of(now[m].normal));
      if (gap > margin * spacing || gap < -deepest * spacing || std::abs(along) > sideways * spacing) return;
      if ((start_of(run_, faces_[k].particle) - start_of(run_, faces_[m].particle)).norm() < bonded) return;
      nearest = r.norm();
      best = {k, m, along};
    };
    const auto [cx, cy] = cell_of(now[k].at);
    for (long y = cy - 1; y <= cy + 1; ++y) {
      for (long x = cx - 1; x <= cx + 1; ++x) {
        const auto at = cells.find({x, y});
        if (at == cells.end()) continue;
        for (const std::size_t m : at->second) consider(m);
      }
    }
    if (best.other != none) partners.push_back(best);
  }
  if (partners.empty()) return {};

  std::vector<bool> wanted(run_.particles.count, false);
  for (const Partner& p : partners) wanted[faces_[p.face].particle] = wanted[faces_[p.other].particle] = true;
  const Seats seats(facing, wanted);
  std::vector<ContactPoint<Dim>> points;
  for (const Partner& p : partners) {
    const FreeFace<Dim>&face = faces_[p.face], &other = faces_[p.other];
    if (seats.face_each_other(face.particle, other.particle)) continue;
    points.push_back(joined(face, other, p.along));
  }
  return points;
}

template <int Dim>
void FreeFaces<Dim>::save(Writer& archive) const {
  archive(searched_at_);
  archive(changed_);
}

template <int Dim>
void FreeFaces<Dim>::load(Reader& archive) {
  find_all();
  std::vector<Vector> searched;
  archive(searched);
  archive(changed_);
  if (searched.size() != faces_.size()) throw ArchiveError("its faces are not those of its bonds");
  searched_at_ = std::move(searched);
}

template class FreeFaces<2>;

}  // namespace fpz::sph::detail
