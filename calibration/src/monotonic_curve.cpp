#include "fpz/calibration/monotonic_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "cubic_spline.hpp"
#include "opening_zone.hpp"

namespace fpz::calibration {
namespace {

using Number = Dual<path_input_count>;  // with derivatives with respect to the inputs
using Slope = MidLine::Slope;
using Zone = CohesiveState<double, 1>;

constexpr int at(PathInput p) { return static_cast<int>(p); }

/// Unknowns of a state: the jumps of the nodes below the tip, from the notch on, and the load.
struct State {
  Eigen::VectorXd jump;
  double load = 0.0;

  [[nodiscard]] Eigen::Index open() const { return jump.size(); }
};

/// What the state is held by besides equilibrium: the traction sigma_t0 at the first closed node (the tip), or the
/// opening at the notch.
struct Hold {
  std::optional<Number> notch_opening;  ///< m; nothing: the tip
};

/// A point of the curve: what the gauge shows of the specimen alone, the load, and the opening at the notch.
struct CurvePoint {
  Number gauge;  ///< m
  Number load;   ///< N
  Number notch_opening;
};

/// States of equilibrium in the order of the growing process zone. They are found one after another, each from the one
/// before, but depend on no history: all zones only open.
class TipPath {
 public:
  TipPath(const Condensation& condensation, const Parameters& parameters, Gauge gauge, bool derivatives)
      : body_(condensation.body),
        d_nu_(condensation.d_nu),
        area_(condensation.area),
        gauge_(static_cast<int>(gauge)),
        derivatives_(derivatives),
        young_modulus_(parameters.young_modulus),
        law_(jump_driven_law(parameters)),
        slope_law_(jump_driven_law(seeded_inputs<Slope>(parameters))),
        fresh_(fresh_zone<double>(law_)),
        fresh_slope_(fresh_zone<Slope>(slope_law_)) {
    Eigen::Index first = 0;
    (body_.load.array() / area_.array()).maxCoeff(&first);
    starts_at_notch_ = first == 0;
    state_.load = area_[0] * law_.surface.tensile_strength / body_.load[0];
    points_.push_back(point(Hold{}));
  }

  [[nodiscard]] const std::vector<CurvePoint>& points() const { return points_; }

  /// False: another node than the one at the notch cracks first, and the states here are not on the way.
  [[nodiscard]] bool starts_at_notch() const { return starts_at_notch_; }

  /// Load over gauge before the first crack.
  [[nodiscard]] Number first_slope() const { return 1.0 / compliance(); }

  /// Adds the next points; false when there is none.
  [[nodiscard]] bool advance() {
    // The last elements below the load stand for long pieces of the curve: states between make up for that.
    constexpr Eigen::Index fine = 8;
    const Eigen::Index tip = state_.open();
    const Eigen::Index left = (area_.size() - 1 - tip) / 2;  // corners above the tip
    const State before = state_;
    const Number from = points_.back().notch_opening;
    if (!by_opening_ && left > 1 && move_tip(tip + 2)) {
      const Eigen::Index parts = (fine + left - 1) / left;
      const State end = state_;
      const CurvePoint last = point(Hold{});
      state_ = before;
      for (Eigen::Index k = 1; k < parts; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(parts);
        const Hold hold{from + part * (last.notch_opening - from)};
        if (open_notch(hold)) points_.push_back(point(hold));
      }
      state_ = end;
      points_.push_back(last);
      return true;
    }
    state_ = before;
    by_opening_ = true;
    constexpr double growth = 1.1;
    const Hold hold{tip > 0 ? growth * from : 1e-3 * Number::seed(law_.softening.length(), at(PathInput::delta0))};
    if (!open_notch(hold)) return false;
    points_.push_back(point(hold));
    return true;
  }

 private:
  /// Gauge per load with the crack closed.
  [[nodiscard]] Number compliance() const {
    Number c = body_.gauge_load[gauge_] / Number::seed(young_modulus_, at(PathInput::young_modulus));
    if (derivatives_) c.grad[at(PathInput::poisson_ratio)] = d_nu_->gauge_load[gauge_] / young_modulus_;
    return c;
  }

  /// Puts the tip at a node. From far away one node in between helps.
  bool move_tip(Eigen::Index node) {
    const State before = state_;
    if (try_tip(node)) return true;
    state_ = before;
    return node > before.open() + 1 && try_tip(node - 1) && try_tip(node);
  }

  bool try_tip(Eigen::Index node) {
    const double opening = state_.open() > 0 ? state_.jump[0] : 0.0;
    const Eigen::Index old = state_.open();
    state_.jump.conservativeResize(node);
    state_.jump.tail(node - old).setZero();
    return solve(Hold{}) && state_.jump[0] > opening && state_.jump.minCoeff() > -1e-6 * law_.softening.length();
  }

  /// Opens the notch, with as many nodes cracked as that takes.
  bool open_notch(const Hold& hold) {
    for (int change = 0; change < 8; ++change) {
      if (state_.open() == 0) state_.jump = Eigen::VectorXd::Zero(1);
      if (!solve(hold)) return false;
      const Eigen::Index m = state_.open();
      if (m == area_.size()) return true;
      const double force = body_.load[m] * state_.load - young_modulus_ * body_.stiffness.row(m).head(m) * state_.jump;
      if (force <= area_[m] * law_.surface.tensile_strength * (1.0 + 1e-9)) return true;
      state_.jump.conservativeResize(m + 1);
      state_.jump[m] = 0.0;
    }
    return false;
  }

  /// Newton's iteration for the state with the present number of open nodes.
  bool solve(const Hold& hold) {
    constexpr int most_iterations = 40;
    constexpr double good = 1e-10;  // of sigma_t0; from here on iterate as long as it helps
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_iterations; ++k) {
      if (!equations(hold)) return false;
      const double error = error_;
      if (error <= 1e-15 || (error <= good && error > 0.25 * before)) return true;
      before = error;
      const Eigen::VectorXd change = matrix_.partialPivLu().solve(-residual_);
      if (!change.allFinite()) return false;
      state_.jump += change.head(state_.open());
      state_.load += change[state_.open()];
    }
    return false;
  }

  /// Residuals of the state, and their matrix: forces of the open nodes, then the hold.
  bool equations(const Hold& hold) {
    using Tangent = Dual<1>;
    const Eigen::Index m = state_.open();
    matrix_.resize(m + 1, m + 1);
    matrix_.topLeftCorner(m, m) = -young_modulus_ * body_.stiffness.topLeftCorner(m, m);
    matrix_.col(m).head(m) = body_.load.head(m);
    residual_.resize(m + 1);
    residual_.head(m) = matrix_.topLeftCorner(m, m) * state_.jump + body_.load.head(m) * state_.load;
    const CohesiveState<Tangent, 1> fresh = lift<Tangent>(fresh_);
    for (Eigen::Index k = 0; k < m; ++k) {
      CohesiveState<Tangent, 1> end;
      law_status_ = open_zone(law_, fresh, Tangent::seed(state_.jump[k], 0), end);
      if (law_status_ != Status::ok) return false;
      residual_[k] -= area_[k] * end.traction[0].val;
      matrix_(k, k) -= area_[k] * end.traction[0].grad[0];
    }
    error_ = m > 0 ? (residual_.head(m).array() / area_.head(m).array()).abs().maxCoeff() : 0.0;
    matrix_.row(m).setZero();
    if (hold.notch_opening) {
      matrix_(m, 0) = 1.0;
      residual_[m] = state_.jump[0] - hold.notch_opening->val;
      error_ += std::abs(residual_[m]) * law_.surface.tensile_strength / law_.softening.length();
    } else {
      matrix_.row(m).head(m) = -young_modulus_ * body_.stiffness.row(m).head(m);
      matrix_(m, m) = body_.load[m];
      residual_[m] =
          matrix_.row(m).head(m) * state_.jump + body_.load[m] * state_.load - area_[m] * law_.surface.tensile_strength;
      error_ = std::max(error_, std::abs(residual_[m] / area_[m]));
    }
    error_ /= law_.surface.tensile_strength;
    return std::isfinite(error_);
  }

  /// Derivatives of the unknowns by the implicit function theorem, one column per input.
  [[nodiscard]] Eigen::MatrixXd slopes(const Hold& hold) {
    const Eigen::Index m = state_.open();
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m + 1, path_input_count);
    const Eigen::Index rows = hold.notch_opening ? m : m + 1;
    right.col(at(PathInput::young_modulus)).head(rows) = -body_.stiffness.topLeftCorner(rows, m) * state_.jump;
    right.col(at(PathInput::poisson_ratio)).head(rows) =
        d_nu_->load.head(rows) * state_.load - young_modulus_ * (d_nu_->stiffness.topLeftCorner(rows, m) * state_.jump);
    if (hold.notch_opening) {
      right.row(m) = -hold.notch_opening->grad.transpose();
    } else {
      right(m, at(PathInput::tensile_strength)) -= area_[m];
    }
    if (!equations(hold)) return right;  // the state has been solved for: this only forms the matrix
    for (Eigen::Index k = 0; k < m; ++k) {
      SlopeZone end;
      law_status_ = open_zone(slope_law_, fresh_slope_, Slope(state_.jump[k]), end);
      right.row(k) -= area_[k] * end.traction[0].grad.head<path_input_count>().transpose();
    }
    return matrix_.partialPivLu().solve(-right);
  }

  [[nodiscard]] CurvePoint point(const Hold& hold) {
    const Eigen::Index m = state_.open();
    const auto jumps = body_.gauge_jump.row(gauge_).head(m);
    CurvePoint p;
    p.load = state_.load;
    p.notch_opening = m > 0 ? state_.jump[0] : 0.0;
    Number gauge_jump = m > 0 ? jumps.dot(state_.jump) : 0.0;
    if (derivatives_) {
      const Eigen::MatrixXd d = slopes(hold);
      p.load.grad = d.row(m).transpose();
      if (m > 0) {
        p.notch_opening.grad = d.row(0).transpose();
        gauge_jump.grad = (jumps * d.topRows(m)).transpose();
        gauge_jump.grad[at(PathInput::poisson_ratio)] += d_nu_->gauge_jump.row(gauge_).head(m).dot(state_.jump);
      }
    }
    p.gauge = gauge_jump + compliance() * p.load;
    return p;
  }

  using SlopeZone = CohesiveState<Slope, 1>;

  const CondensedBody& body_;
  const std::optional<CondensedBody>& d_nu_;
  const Eigen::VectorXd& area_;
  int gauge_;
  bool derivatives_;
  double young_modulus_;
  CohesiveLaw<double> law_;
  CohesiveLaw<Slope> slope_law_;
  Zone fresh_;
  SlopeZone fresh_slope_;
  State state_;
  std::vector<CurvePoint> points_;
  bool starts_at_notch_ = false;
  bool by_opening_ = false;  ///< no further corner can be reached: the notch is opened step by step
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd residual_;
  double error_ = 0.0;  ///< largest residual over sigma_t0
  Status law_status_ = Status::ok;
};

/// What the toe takes up of the reading, and its derivatives, when Q is the largest load so far; below zero load it
/// goes on as a spring.
struct Toe {
  double reading = 0.0;
  double per_load = 0.0;
  double per_toe = 0.0;
  double per_toe_load = 0.0;
};

Toe toe_at(const Control& c, double largest) {
  if (c.toe_load == 0.0) return {};
  const double x = largest / c.toe_load;
  if (x < 0.0) return {c.toe * x, c.toe / c.toe_load, x, -c.toe * x / c.toe_load};
  const double left = std::exp(-x);
  return {c.toe * (1.0 - left), c.toe * left / c.toe_load, 1.0 - left, -c.toe * left * x / c.toe_load};
}

double reading_at(const CurvePoint& p, const Control& control, double largest) {
  return p.gauge.val + control.offset + control.machine_compliance * p.load.val + toe_at(control, largest).reading;
}

/// Points of the curve with readings that grow, and the last reading.
struct PointList {
  std::vector<CurvePoint> points;
  double last = 0.0;
};

/// The points up to and a little beyond a reading, as long as gauge and reading grow.
PointList points_up_to(TipPath& path, const Control& control, double reading) {
  constexpr std::size_t beyond = 2;  // more points, for the curvature at the end
  constexpr std::size_t most = 5000;
  PointList out;
  double largest = 0.0;
  std::size_t after = 0;
  for (std::size_t k = 0; after < beyond && k < most; ++k) {
    if (k == path.points().size() && !path.advance()) break;
    const CurvePoint& p = path.points()[k];
    largest = std::max(largest, p.load.val);
    const double now = reading_at(p, control, largest);
    if (!out.points.empty() && !(p.gauge > out.points.back().gauge && now > out.last)) break;
    out.points.push_back(p);
    out.last = now;
    if (now >= reading) ++after;
  }
  return out;
}

/// Where a spline between two places has slope zero, falling.
double top_between(const CubicSpline<Number>& curve, double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (curve.slope_at(middle).val > 0.0 ? low : high) = middle;
  }
  return low;
}

/// The curve as the machine records it.
class RecordedCurve {
 public:
  RecordedCurve(const std::vector<CurvePoint>& points, const Number& first_slope, const Control& control)
      : control_(control), curve_(column(points, &CurvePoint::gauge), column(points, &CurvePoint::load), first_slope) {
    last_ = points.back().gauge.val;
    const auto top = std::max_element(points.begin(), points.end(),
                                      [](const CurvePoint& a, const CurvePoint& b) { return a.load < b.load; });
    if (top == points.begin() || top + 1 == points.end()) return;
    peak_ = top_between(curve_, (top - 1)->gauge.val, (top + 1)->gauge.val);
    peak_load_ = curve_.at(peak_);
  }

  /// Load at a reading and its derivatives. Between gauge and reading stands
  /// gauge = reading - offset - machine_compliance P - toe(Q).
  [[nodiscard]] double load_at(double reading, Eigen::MatrixXd::RowXpr* derivatives) const {
    const double gauge = gauge_at(reading);
    const Number p = curve_.at(gauge);
    if (derivatives == nullptr) return p.val;
    const double slope = curve_.slope_at(gauge).val;
    const bool rising = gauge < peak_;
    const Toe toe = toe_at(control_, rising ? p.val : peak_load_.val);
    Eigen::Matrix<double, curve_input_count, 1> moved = Eigen::Matrix<double, curve_input_count, 1>::Zero();
    moved[at(PathInput::gauge_offset)] = 1.0;
    moved[at(PathInput::machine_compliance)] = p.val;
    moved[toe_column] = toe.per_toe;
    moved[toe_load_column] = toe.per_toe_load;
    if (!rising) moved.head<path_input_count>() += toe.per_load * peak_load_.grad;
    Eigen::Matrix<double, curve_input_count, 1> d = -slope * moved;
    d.head<path_input_count>() += p.grad;
    *derivatives = d.transpose() / (1.0 + (control_.machine_compliance + (rising ? toe.per_load : 0.0)) * slope);
    return p.val;
  }

 private:
  static std::vector<Number> column(const std::vector<CurvePoint>& points, Number CurvePoint::*member) {
    std::vector<Number> out;
    for (const CurvePoint& p : points) out.push_back(p.*member);
    return out;
  }

  /// By Newton's iteration in a bracket; the reading grows with the gauge.
  [[nodiscard]] double gauge_at(double reading) const {
    const double wanted = reading - control_.offset;
    if (control_.machine_compliance == 0.0 && control_.toe_load == 0.0) return wanted;
    double low = std::min(0.0, wanted);
    double high = last_;
    double g = 0.5 * (low + high);
    for (int k = 0; k < 200 && high - low > 1e-16 * std::abs(wanted); ++k) {
      const double load = curve_.at(g).val;
      const Toe toe = toe_at(control_, g < peak_ ? load : peak_load_.val);
      const double miss = g + control_.machine_compliance * load + toe.reading - wanted;
      (miss > 0.0 ? high : low) = g;
      const double softer = control_.machine_compliance + (g < peak_ ? toe.per_load : 0.0);
      const double next = g - miss / (1.0 + softer * curve_.slope_at(g).val);
      const bool inside = next > low && next < high;
      if (inside && std::abs(next - g) <= 1e-15 * std::abs(wanted)) return next;
      g = inside ? next : 0.5 * (low + high);
    }
    return g;
  }

  Control control_;
  CubicSpline<Number> curve_;
  double last_ = 0.0;                                      ///< gauge of the last point
  double peak_ = std::numeric_limits<double>::infinity();  ///< gauge at the largest load; infinite where it still rises
  Number peak_load_;
};

}  // namespace

MonotonicCurve monotonic_curve(const Condensation& condensation, const Parameters& parameters, const Control& control,
                               const Eigen::VectorXd& readings, bool derivatives) {
  MonotonicCurve out;
  TipPath path(condensation, parameters, control.gauge, derivatives);
  const double wanted = readings.maxCoeff();
  const auto [points, last] = points_up_to(path, control, wanted);
  if (!path.starts_at_notch() || points.size() < 2 || last < wanted) {
    std::ostringstream text;
    text << "the curve under growing readings ends at " << last << " m, before the reading of " << wanted << " m";
    out.failure = text.str();
    return out;
  }
  const RecordedCurve curve(points, path.first_slope(), control);
  out.load.resize(readings.size());
  if (derivatives) out.derivatives.resize(readings.size(), curve_input_count);
  for (Eigen::Index k = 0; k < readings.size(); ++k) {
    if (derivatives) {
      Eigen::MatrixXd::RowXpr row = out.derivatives.row(k);
      out.load[k] = curve.load_at(readings[k], &row);
    } else {
      out.load[k] = curve.load_at(readings[k], nullptr);
    }
  }
  return out;
}

MonotonicCurve peak_of_curve(const Condensation& condensation, const Parameters& parameters, bool derivatives) {
  constexpr std::size_t beyond = 3;
  constexpr std::size_t most = 2000;
  MonotonicCurve out;
  TipPath path(condensation, parameters, Gauge::cmod, derivatives);
  const auto& points = path.points();
  std::size_t top = 0;
  while (points.size() < most && points.size() < top + 1 + beyond && path.advance()) {
    for (std::size_t k = top + 1; k < points.size(); ++k) top = points[k].load > points[top].load ? k : top;
  }
  if (!path.starts_at_notch() || top == 0 || top + 1 >= points.size()) {
    out.failure = "no peak of the load was found";
    return out;
  }
  std::vector<Number> opening, load;
  for (const CurvePoint& p : points) {
    opening.push_back(p.notch_opening);
    load.push_back(p.load);
  }
  const Number first = (load[1] - load[0]) / (opening[1] - opening[0]);
  const double low = opening[top - 1].val;
  const double high = opening[top + 1].val;
  const CubicSpline<Number> curve(std::move(opening), std::move(load), first);
  const Number peak = curve.at(top_between(curve, low, high));
  out.load = Eigen::VectorXd::Constant(1, peak.val);
  if (!derivatives) return out;
  out.derivatives = Eigen::MatrixXd::Zero(1, curve_input_count);
  out.derivatives.leftCols<path_input_count>() = peak.grad.transpose();
  return out;
}

}  // namespace fpz::calibration
