#include "contact_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fpz/sph/linear_fit.hpp"

namespace fpz::sph::detail {

namespace {

using Vec2 = Vec<double, 2>;

constexpr double reach = face_reach;
constexpr double beside = 1.1;      // spacings: no face where no particle is nearer,
constexpr double ahead = 0.75;      // or where all lie this far to one side along it
constexpr double before_tip = 0.9;  // spacings: from there on bonds cross the cut in part (share_of_bond)

Vec2 start_of(const RunData<2>& run, std::size_t i) { return {run.particles.start[0][i], run.particles.start[1][i]}; }

}  // namespace

std::optional<FaceSide> fitted_side(const RunData<2>& run, const Vec2& x, const Vec2& along,
                                    const std::vector<std::size_t>& particles) {
  constexpr double most = 4.0;  // sum of the sizes of the weights; two rows have 2, or 3 at the end of a face
  const double length = reach * run.setup.arrangement.spacing;
  std::vector<Vec2> seen;
  std::vector<double> volume;
  for (const std::size_t i : particles) {
    seen.emplace_back((start_of(run, i) - x) / length);
    volume.push_back(run.particles.volume[i]);
  }
  const LinearFit fit(seen, volume);
  if (!fit.is_determined()) return std::nullopt;
  FaceSide side{particles, fit.weights(Eigen::Vector3d::UnitX()),
                fit.weights(Eigen::Vector3d(0.0, along[0], along[1]) / length)};
  double size = 0.0;
  for (const double w : side.weight) size += std::abs(w);
  return size < most ? std::optional(side) : std::nullopt;
}

namespace {

/// A place on a face, the direction along it, and the one into its body.
struct FacePlace {
  std::optional<std::size_t> cut;  ///< that the face belongs to, where it is known
  Vec2 at, along, inward;
};

/// Whether the particle at x lies behind the face and no other cut hides it.
bool is_behind(const std::vector<Cut<2>>& cuts, const FacePlace& face, const Vec2& x) {
  if ((x - face.at).dot(face.inward) <= 0.0) return false;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (face.cut != k && crosses(cuts[k], face.at, x)) return false;
  }
  return true;
}

/// The particles behind a place. Nothing where the body is too far away.
std::optional<FaceSide> side_behind(const RunData<2>& run, const FacePlace& face) {
  const Arrangement<2>& a = run.setup.arrangement;
  const Vec2& along = face.along;
  std::vector<std::size_t> particles;
  double nearest = reach, first = reach, last = -reach;
  for (std::size_t i = 0; i < run.particles.count; ++i) {
    const Vec2 x = start_of(run, i), r = (x - face.at) / a.spacing;
    if (r.norm() >= reach || !is_behind(a.cuts, face, x)) continue;
    particles.push_back(i);
    nearest = std::min(nearest, r.norm());
    first = std::min(first, along.dot(r));
    last = std::max(last, along.dot(r));
  }
  if (nearest > beside || first > ahead || last < -ahead) return std::nullopt;
  return fitted_side(run, face.at, along, particles);
}

Vec2 displacement(const RunData<2>& run, std::size_t i) {
  return Vec2(run.particles.position[0][i], run.particles.position[1][i]) - start_of(run, i);
}

Vec2 displacement(const RunData<2>& run, const FaceSide& side) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t k = 0; k < side.particle.size(); ++k) sum += side.weight[k] * displacement(run, side.particle[k]);
  return sum;
}

/// The particles around a place of the rough face of a crack that move with side 1 and not with side 0.
std::optional<FaceSide> side_that_moves_alike(const RunData<2>& run, const std::array<FaceSide, 2>& side,
                                              const Vec2& place, const Vec2& along) {
  const Vec2 other = displacement(run, side[0]), own = displacement(run, side[1]);
  const double spacing = run.setup.arrangement.spacing;
  std::vector<std::size_t> particles;
  double nearest = reach;
  for (std::size_t i = 0; i < run.particles.count; ++i) {
    const double r = (start_of(run, i) - place).norm() / spacing;
    if (r >= reach) continue;
    const Vec2 u = displacement(run, i);
    if ((u - own).norm() >= (u - other).norm()) continue;
    particles.push_back(i);
    nearest = std::min(nearest, r);
  }
  if (nearest > beside) return std::nullopt;
  return fitted_side(run, place, along, particles);
}

/// The face in the middle of a bond that was cut, on the side of one of its ends, which is the first particle. The end
/// alone when too few neighbours are left to it.
FaceSide side_of_bond(const RunData<2>& run, const NeighbourLists& lists, std::size_t end, const Vec2& middle,
                      const Vec2& along, const Vec2& inward) {
  std::vector<std::size_t> particles = {end};
  for (const int j : lists[end]) {
    const Vec2 r = start_of(run, static_cast<std::size_t>(j)) - middle;
    if (r.dot(inward) > 0.0 && r.norm() < reach * run.setup.arrangement.spacing) {
      particles.push_back(static_cast<std::size_t>(j));
    }
  }
  return fitted_side(run, middle, along, particles).value_or(FaceSide{{end}, {1.0}, {0.0}});
}

void add_points(const RunData<2>& run, std::size_t k, std::vector<ContactPoint<2>>& points) {
  const Cut<2>& cut = run.setup.arrangement.cuts[k];
  const double spacing = run.setup.arrangement.spacing;
  const Vec2 line = cut.corner[1] - cut.corner[0], along = line.normalized();
  const Vec2 normal(-along[1], along[0]), half = 0.5 * cut.width * normal, tangent = -along;
  const double begin = cut.is_tip[0] ? before_tip * spacing : 0.0;
  const double length = line.norm() - begin - (cut.is_tip[1] ? before_tip * spacing : 0.0);
  const auto count = static_cast<int>(std::ceil(length / spacing - 1e-6));
  for (int n = 0; n < count; ++n) {
    const Vec2 middle = cut.corner[0] + (begin + (n + 0.5) * length / count) * along;
    auto right = side_behind(run, {k, middle - half, tangent, -normal});
    auto left = side_behind(run, {k, middle + half, tangent, normal});
    if (!right || !left) continue;
    ContactPoint<2>& point = points.emplace_back();
    point.side = {std::move(*right), std::move(*left)};
    point.normal = normal;
    point.room = cut.gap - cut.width;
    point.law = contact_law(run, point.side, length / count, cut.friction);
    point.at_start = cut.width * normal;
  }
}

}  // namespace

template <int Dim>
ContactLaw contact_law(const RunData<Dim>& run, const std::array<FaceSide, 2>& side, double area, double friction) {
  const double stiffness = run.setup.options.contact_stiffness * area / run.setup.arrangement.spacing;
  const std::size_t a = side[0].particle.front(), b = side[1].particle.front();
  const ParticleMaterials<Dim>& m = run.materials;
  return {stiffness * in_series(m.confined_modulus(a), m.confined_modulus(b)),
          stiffness * in_series(m.bulk(a).mu, m.bulk(b).mu), friction};
}

template <int Dim>
void fit_sides_of_bond(const RunData<Dim>& run, const NeighbourLists& lists, ContactPoint<Dim>& point) {
  const std::size_t from = point.side[0].particle[0], to = point.side[1].particle[0];
  const Vec2 middle = 0.5 * (start_of(run, from) + start_of(run, to));
  const Vec2 left(-point.normal[1], point.normal[0]);
  point.side = {side_of_bond(run, lists, from, middle, left, -point.normal),
                side_of_bond(run, lists, to, middle, left, point.normal)};
}

template <int Dim>
std::optional<ContactPoint<Dim>> point_of_bond(const RunData<Dim>& run, const NeighbourLists& lists,
                                               const ReleasedBond<Dim>& bond) {
  constexpr double longest = 1.6, steepest = 0.3;  // spacings; cosine between bond and normal
  constexpr double share = 1.0 / 3.0;              // about three such bonds end at a particle beside a face
  const double spacing = run.setup.arrangement.spacing;
  const Vec2 r = start_of(run, bond.to) - start_of(run, bond.from);
  if (r.norm() > longest * spacing || bond.normal.dot(r) < steepest * r.norm()) return {};
  ContactPoint<Dim> point;
  point.of_crack = true;
  point.side = {FaceSide{{bond.from}, {1.0}, {0.0}}, FaceSide{{bond.to}, {1.0}, {0.0}}};
  point.normal = bond.normal;
  point.law = contact_law(run, point.side, share * std::sqrt(run.particles.volume[bond.from]),
                          std::tan(degree * run.materials.parameters(bond.from).friction_angle_deg));
  fit_sides_of_bond(run, lists, point);
  return point;
}

template <int Dim>
std::optional<FaceSide> side_opposite(const RunData<Dim>& run, const ContactPoint<Dim>& point, double slid) {
  const FaceSide& side = point.side[1];
  Vec<double, Dim> place = Vec<double, Dim>::Zero();  // the weights are right for linear fields
  for (std::size_t k = 0; k < side.particle.size(); ++k) place += side.weight[k] * start_of(run, side.particle[k]);
  const Vec<double, Dim> left(-point.normal[1], point.normal[0]);
  if (point.of_crack) return side_that_moves_alike(run, point.side, place - slid * left, left);
  return side_behind(run, {std::nullopt, place - slid * left, left, point.normal});
}

template <int Dim>
std::vector<ContactPoint<Dim>> points_of_cuts(const RunData<Dim>& run) {
  std::vector<ContactPoint<Dim>> points;
  for (std::size_t k = 0; k < run.setup.arrangement.cuts.size(); ++k) add_points(run, k, points);
  return points;
}

template void fit_sides_of_bond<2>(const RunData<2>&, const NeighbourLists&, ContactPoint<2>&);
template std::optional<ContactPoint<2>> point_of_bond<2>(const RunData<2>&, const NeighbourLists&,
                                                         const ReleasedBond<2>&);
template std::optional<FaceSide> side_opposite<2>(const RunData<2>&, const ContactPoint<2>&, double);
template ContactLaw contact_law<2>(const RunData<2>&, const std::array<FaceSide, 2>&, double, double);
template std::vector<ContactPoint<2>> points_of_cuts<2>(const RunData<2>&);

}  // namespace fpz::sph::detail
