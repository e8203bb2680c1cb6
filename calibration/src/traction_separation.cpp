#include "fpz/calibration/traction_separation.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>

#include "admissible.hpp"
#include "fpz/calibration/onset_traction.hpp"
#include "jet.hpp"
#include "zone.hpp"

namespace fpz::calibration {
namespace {

/// A zone on its way through the rows of a test.
template <class T>
class ZoneRun {
 public:
  using Zone = CohesiveState<T, 2>;

  ZoneRun(const TractionSeparationTest& test, const BasicParameters<T>& p)
      : test_(test), law_(jump_driven_law(p)), plain_(values(law_)) {
    options_.tolerance = test.tolerance;
    // The normal traction is held by a soft spring in series with the zone, whose far end is moved so that the traction
    // is right at every row. In between it follows the zone's dilation, less than delta0, divided by this compliance.
    spring_ = 1e3 * law_.softening.length() / law_.surface.tensile_strength;
  }

  /// Puts the zone at its start; otherwise says why there is none.
  [[nodiscard]] std::string start() {
    if (!test_.elastic_before_onset) return start_at_onset();
    const ZoneRow& first = test_.rows.front();
    if (!first.normal_traction) return {};
    const Report report = move(0.0, first);
    reference_ = zone_.jump[0];
    return report.ok() ? std::string() : explanation(0, report);
  }

  /// Takes the zone to a row; otherwise says why not.
  [[nodiscard]] std::string go_to(std::size_t row) {
    const Report report = move(test_.rows[row].shear_jump, test_.rows[row]);
    return report.ok() ? std::string() : explanation(row, report);
  }

  [[nodiscard]] T observed(ZoneQuantity q) const {
    switch (q) {
      case ZoneQuantity::normal_traction:
        return zone_.traction[0];
      case ZoneQuantity::shear_traction:
        return zone_.traction[1];
      case ZoneQuantity::normal_jump:
        return zone_.jump[0] - reference_;
    }
    return T(0.0);
  }

 private:
  [[nodiscard]] std::string start_at_onset() {
    const ZoneRow& first = test_.rows.front();
    const auto sheared =
        std::find_if(test_.rows.begin(), test_.rows.end(), [](const ZoneRow& r) { return r.shear_jump != 0.0; });
    const double sign = sheared != test_.rows.end() && sheared->shear_jump < 0.0 ? -1.0 : 1.0;
    Vec<T, 2> onset;
    if (first.normal_traction) {
      const double normal = *first.normal_traction;
      if (!(normal < plain_.surface.tensile_strength))
        return "row 1: its normal traction is not below the tensile strength";
      const T radius = law_.surface.cohesion - normal * law_.surface.tan_phi;
      onset[0] = T(normal);
      onset[1] = sign * surface_shear(radius, law_.surface.apex);
    } else {
      const auto moved = std::find_if(test_.rows.begin(), test_.rows.end(), [](const ZoneRow& r) {
        return r.shear_jump != 0.0 || r.normal_jump.value_or(0.0) != 0.0;
      });
      if (moved == test_.rows.end() || !moved->normal_jump) return "no row gives the direction of the first jump";
      Vec<double, 2> direction;
      direction << *moved->normal_jump, std::abs(moved->shear_jump);
      const auto found = onset_traction(law_, Vec<double, 2>(direction / direction.norm()), test_.onset_angle_deg);
      if (!found) return "no onset: the direction of the first jump presses the plane shut within friction";
      onset = *found;
      onset[1] *= T(moved->shear_jump < 0.0 ? -1.0 : 1.0);
    }
    zone_ = cracked_at<T, 2>(law_, onset);
    return {};
  }

  [[nodiscard]] Report move(double shear_jump, const ZoneRow& row) {
    if (row.normal_traction) return move_under(*row.normal_traction, shear_jump);
    Vec<T, 2> du;
    du << reference_ + *row.normal_jump - zone_.jump[0], shear_jump - zone_.jump[1];
    return move_zone(law_, options_, zone_, du, zone_);
  }

  template <class S, class P>
  [[nodiscard]] Report pull(const CohesiveLaw<P>& law, const P& spring, const CohesiveState<S, 2>& begin, const S& end,
                            double shear_jump, CohesiveState<S, 2>& out) const {
    Drive<S, 2> drive;
    drive.from << begin.jump[0] + spring * begin.traction[0], begin.jump[1];
    drive.to << end, S(shear_jump);
    return follow_zone(law, SeriesCompliance<P>{spring, P(0.0)}, options_, begin, drive, out);
  }

  /// Finds where the far end of the spring has to go. The zone is much stiffer, so taking over its jump converges fast;
  /// the derivatives follow from the implicit function theorem.
  [[nodiscard]] Report move_under(double traction, double shear_jump) {
    const CohesiveState<double, 2> begin = lift<double>(zone_);
    CohesiveState<double, 2> out;
    const double spring = value(spring_);
    double end = begin.jump[0] + spring * traction;
    const double scale = std::max(std::abs(traction), plain_.surface.tensile_strength);
    double miss = 0.0;
    for (int k = 0; k < 50; ++k) {
      const Report report = pull(plain_, spring, begin, end, shear_jump, out);
      if (!report.ok()) return report;
      miss = out.traction[0] - traction;
      if (std::abs(miss) <= 1e-13 * scale) break;
      end = spring * traction + out.jump[0];
    }
    if (std::abs(miss) > 1e-10 * scale) return {Status::non_convergence, 0, 0, false};
    if constexpr (std::is_same_v<T, double>) {
      zone_ = out;
      return {};
    } else {
      CohesiveState<Dual<1>, 2> moved;
      const Report slope = pull(plain_, spring, lift<Dual<1>>(begin), Dual<1>::seed(end, 0), shear_jump, moved);
      if (!slope.ok()) return slope;
      Zone fixed;
      const Report report = pull(law_, spring_, zone_, T(end), shear_jump, fixed);
      if (!report.ok()) return report;
      const T followed = end - (fixed.traction[0] - value(fixed.traction[0])) / moved.traction[0].grad[0];
      return pull(law_, spring_, Zone(zone_), followed, shear_jump, zone_);
    }
  }

  [[nodiscard]] std::string explanation(std::size_t row, const Report& report) const {
    std::ostringstream text;
    text << "row " << row + 1 << ": ";
    const std::optional<double>& held = test_.rows[row].normal_traction;
    if (held && *held >= plain_.surface.tensile_strength * value(zone_.integrity)) {
      text << "the normal traction of " << *held << " Pa is more than the zone can carry";
    } else if (held && report.status == Status::snap_back) {
      text << "the zone separates at once under the normal traction of " << *held
           << " Pa; no equilibrium leads on. Use less tension, or prescribe the normal jump";
    } else {
      text << "the zone cannot be followed (" << to_string(report.status) << ")";
    }
    return text.str();
  }

  const TractionSeparationTest& test_;
  CohesiveLaw<T> law_;
  CohesiveLaw<double> plain_;
  T spring_;  ///< m/Pa
  Options options_;
  Zone zone_;
  T reference_ = T(0.0);  ///< normal jump that counts as zero
};

std::string problem(const TractionSeparationTest& test) {
  if (test.rows.empty()) return "the history has no rows";
  for (std::size_t k = 0; k < test.rows.size(); ++k) {
    const ZoneRow& r = test.rows[k];
    const std::string where = "row " + std::to_string(k + 1) + ": ";
    if (r.normal_jump.has_value() == r.normal_traction.has_value()) {
      return where + "either the normal jump or the normal traction must be prescribed";
    }
    if (!std::isfinite(r.shear_jump + r.normal_jump.value_or(0.0) + r.normal_traction.value_or(0.0))) {
      return where + "a prescribed value is not a finite number";
    }
  }
  for (const ZonePoint& x : test.points) {
    if (x.row < 0 || static_cast<std::size_t>(x.row) >= test.rows.size()) {
      return "a measured value names row " + std::to_string(x.row + 1) + " of " + std::to_string(test.rows.size());
    }
  }
  return {};
}

template <class T>
std::string run(const TractionSeparationTest& test, const BasicParameters<T>& p, std::vector<T>& values_at_points) {
  ZoneRun<T> zone(test, p);
  if (std::string why = zone.start(); !why.empty()) return why;
  for (std::size_t row = 0; row < test.rows.size(); ++row) {
    if (std::string why = zone.go_to(row); !why.empty()) return why;
    for (std::size_t i = 0; i < test.points.size(); ++i) {
      const ZonePoint& x = test.points[i];
      if (static_cast<std::size_t>(x.row) == row) values_at_points[i] = zone.observed(x.quantity);
    }
  }
  return {};
}

}  // namespace

Prediction predict(const TractionSeparationTest& test, const Parameters& parameters, bool derivatives) {
  if (std::string why = why_inadmissible(parameters); !why.empty()) return failed(std::move(why));
  if (std::string why = problem(test); !why.empty()) return failed(std::move(why));
  const auto n = static_cast<Eigen::Index>(test.points.size());
  Prediction out;
  out.values.resize(n);
  if (!derivatives) {
    std::vector<double> found(test.points.size());
    if (std::string why = run(test, parameters, found); !why.empty()) return failed(std::move(why));
    for (Eigen::Index i = 0; i < n; ++i) out.values[i] = found[static_cast<std::size_t>(i)];
    return out;
  }
  std::vector<Jet> found(test.points.size());
  if (std::string why = run(test, seeded(parameters), found); !why.empty()) return failed(std::move(why));
  out.jacobian.resize(n, parameter_count);
  for (Eigen::Index i = 0; i < n; ++i) {
    out.values[i] = found[static_cast<std::size_t>(i)].a;
    out.jacobian.row(i) = found[static_cast<std::size_t>(i)].v.transpose();
  }
  return out;
}

}  // namespace fpz::calibration
