#include "contact_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace fpz::sph::detail {

namespace {

using Vec2 = Vec<double, 2>;

constexpr double reach = 2.25;      // spacings, of the particles that a place of a face moves with: two rows and a half
constexpr double beside = 1.1;      // spacings: no face where no particle is nearer,
constexpr double ahead = 0.75;      // or where all lie this far to one side along it
constexpr double before_tip = 0.9;  // spacings: from there on bonds cross the cut in part (share_of_bond)

/// A place on a face, and the direction into its body.
struct FacePlace {
  std::size_t cut;
  Vec2 at, inward;
};

/// Whether the particle at x lies behind the face and no other cut hides it.
bool is_behind(const std::vector<Cut<2>>& cuts, const FacePlace& face, const Vec2& x) {
  if ((x - face.at).dot(face.inward) <= 0.0) return false;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    if (k != face.cut && crosses(cuts[k], face.at, x)) return false;
  }
  return true;
}

/// The particles behind a place, with weights that reproduce linear fields: the place then moves as the body does, and
/// its forces have the right moment. Nothing where the body is too far away.
std::optional<FaceSide> side_behind(const RunData<2>& run, const FacePlace& face) {
  const Particles<2>& p = run.particles;
  const Arrangement<2>& a = run.setup.arrangement;
  FaceSide side;
  std::vector<Eigen::Vector3d> terms;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  const Vec2 along(-face.inward[1], face.inward[0]);
  double nearest = reach, first = reach, last = -reach;
  for (std::size_t i = 0; i < p.count; ++i) {
    const Vec2 x(p.start[0][i], p.start[1][i]);
    const Vec2 r = (x - face.at) / a.spacing;
    const double q = r.squaredNorm() / (reach * reach);
    if (q >= 1.0 || !is_behind(a.cuts, face, x)) continue;
    nearest = std::min(nearest, r.norm());
    first = std::min(first, along.dot(r));
    last = std::max(last, along.dot(r));
    const Eigen::Vector3d place(1.0, r[0], r[1]);
    side.particle.push_back(i);
    terms.push_back((1.0 - q) * (1.0 - q) * p.volume[i] / (a.spacing * a.spacing) * place);
    moments += terms.back() * place.transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> factors(moments);
  if (nearest > beside || first > ahead || last < -ahead || !factors.isInvertible()) return std::nullopt;
  const Eigen::Vector3d constants = factors.solve(Eigen::Vector3d::UnitX());
  for (const Eigen::Vector3d& t : terms) side.weight.push_back(t.dot(constants));
  return side;
}

void add_points(const RunData<2>& run, std::size_t k, std::vector<ContactPoint<2>>& points) {
  const Cut<2>& cut = run.setup.arrangement.cuts[k];
  const double spacing = run.setup.arrangement.spacing;
  const Vec2 line = cut.corner[1] - cut.corner[0], along = line.normalized();
  const Vec2 normal(-along[1], along[0]), half = 0.5 * cut.width * normal;
  const double begin = cut.is_tip[0] ? before_tip * spacing : 0.0;
  const double length = line.norm() - begin - (cut.is_tip[1] ? before_tip * spacing : 0.0);
  const auto count = static_cast<int>(std::ceil(length / spacing - 1e-6));
  for (int n = 0; n < count; ++n) {
    const Vec2 middle = cut.corner[0] + (begin + (n + 0.5) * length / count) * along;
    auto right = side_behind(run, {k, middle - half, -normal});
    auto left = side_behind(run, {k, middle + half, normal});
    if (!right || !left) continue;
    ContactPoint<2>& point = points.emplace_back();
    point.side = {std::move(*right), std::move(*left)};
    point.normal = normal;
    point.room = cut.gap - cut.width;
    point.law = contact_law(run, length / count, cut.friction);
    point.at_start = point.distance = cut.width * normal;
  }
}

}  // namespace

template <int Dim>
ContactLaw contact_law(const RunData<Dim>& run, double area, double friction) {
  const double stiffness = run.setup.options.contact_stiffness * area / run.setup.arrangement.spacing;
  return {stiffness * (run.view.lambda + 2.0 * run.view.mu), stiffness * run.view.mu, friction};
}

template <int Dim>
std::vector<ContactPoint<Dim>> points_of_cuts(const RunData<Dim>& run) {
  std::vector<ContactPoint<Dim>> points;
  for (std::size_t k = 0; k < run.setup.arrangement.cuts.size(); ++k) add_points(run, k, points);
  return points;
}

template ContactLaw contact_law<2>(const RunData<2>&, double, double);
template std::vector<ContactPoint<2>> points_of_cuts<2>(const RunData<2>&);

}  // namespace fpz::sph::detail
