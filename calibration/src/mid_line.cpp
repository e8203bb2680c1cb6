#include "fpz/calibration/mid_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "fpz/energy.hpp"
#include "opening_zone.hpp"

namespace fpz::calibration {
namespace {

using Inputs = Eigen::Matrix<double, path_input_count, 1>;

constexpr int at(PathInput p) { return static_cast<int>(p); }

const char* name(Gauge g) {
  if (g == Gauge::cmod) return "CMOD";
  return is_opening(g) ? "opening on the load line" : "deflection";
}

}  // namespace

MidLine::MidLine(const Condensation& condensation, const Parameters& parameters, const Control& control,
                 bool derivatives)
    : body_(condensation),
      young_modulus_(parameters.young_modulus),
      control_(control),
      derivatives_(derivatives),
      law_(jump_driven_law(parameters)),
      slope_law_(jump_driven_law(seeded_inputs<Slope>(parameters))),
      stiffness_(parameters.young_modulus * condensation.body.stiffness),
      reading_per_load_(condensation.body.gauge_load[static_cast<int>(control.gauge)] / parameters.young_modulus +
                        control.machine_compliance) {
  const Eigen::Index n = body_.area.size();
  now_.reading = control.offset;
  now_.load_rate = 1.0 / reading_per_load_;
  now_.jump = now_.jump_rate = Eigen::VectorXd::Zero(n);
  now_.cracked.assign(static_cast<std::size_t>(n), false);
  now_.zones.resize(static_cast<std::size_t>(n));
  if (derivatives) now_.slopes.resize(static_cast<std::size_t>(n));
}

std::string MidLine::advance(double reading) {
  constexpr double smallest_step = 1e-7;
  const double scale = std::abs(reading - control_.offset) + std::abs(now_.reading - control_.offset);
  double step = reading - now_.reading;
  while (now_.reading != reading || steps_ == 0) {
    const bool last = std::abs(step) >= std::abs(reading - now_.reading);
    State next;
    if (step_to(last ? reading : now_.reading + step, next)) {
      now_ = std::move(next);
      largest_load_ = std::max(largest_load_, std::abs(now_.load));
      ++steps_;
      step *= 2.0;
    } else {
      step *= 0.5;
      if (std::abs(step) < smallest_step * scale) return why_stuck(reading);
    }
  }
  return {};
}

bool MidLine::step_to(double reading, State& next) {
  constexpr int most_changes = 40;
  // 1. Start from the tangent prediction.
  next.reading = reading;
  next.cracked = now_.cracked;
  next.load = now_.load + now_.load_rate * (reading - now_.reading);
  next.jump = now_.jump + now_.jump_rate * (reading - now_.reading);

  // 2. Equilibrium, until the set of cracked nodes is right.
  System system = make_system(next);
  if (change_set(next, system)) system = make_system(next);
  for (int k = 0;; ++k) {
    if (k == most_changes) return false;
    if (k > 0) system = make_system(next);
    if (!newton(next, system)) return false;
    if (!change_set(next, system)) break;
  }
  if (!unique_) return false;
  set_rates(next, system);
  if (!close_to_prediction(next)) return false;

  // 3. End states.
  next.zones = now_.zones;
  for (std::size_t k = 0; k < system.nodes.size(); ++k) {
    next.zones[static_cast<std::size_t>(system.nodes[k])] = system.zones[k];
  }
  return !derivatives_ || differentiate(next, system);
}

MidLine::System MidLine::make_system(const State& state) const {
  System s;
  for (std::size_t i = 0; i < state.cracked.size(); ++i) {
    if (state.cracked[i]) s.nodes.push_back(static_cast<Eigen::Index>(i));
  }
  const auto m = static_cast<Eigen::Index>(s.nodes.size());
  s.stiffness = stiffness_(s.nodes, s.nodes);
  s.load = body_.body.load(s.nodes);
  s.gauge = body_.body.gauge_jump.row(static_cast<int>(control_.gauge)).transpose()(s.nodes);
  s.area = body_.area(s.nodes);
  s.jump = state.jump(s.nodes);
  s.zones.resize(s.nodes.size());
  s.tangent.resize(m);
  return s;
}

bool MidLine::evaluate(const State& next, System& s) {
  using Tangent = Dual<1>;
  s.residual = s.load * next.load;
  s.residual.noalias() -= s.stiffness * s.jump;
  const CohesiveState<double, 1> fresh = fresh_zone<double>(law_);
  for (std::size_t k = 0; k < s.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(s.nodes[k]);
    const auto row = static_cast<Eigen::Index>(k);
    const CohesiveState<double, 1>& begin = now_.cracked[node] ? now_.zones[node] : fresh;
    CohesiveState<Tangent, 1> end;
    law_status_ = open_zone(law_, lift<Tangent>(begin), Tangent::seed(s.jump[row], 0), end);
    if (law_status_ != Status::ok) return false;
    s.zones[k] = lift<double>(end);
    s.tangent[row] = end.traction[0].grad[0];
    s.residual[row] -= s.area[row] * end.traction[0].val;
  }
  s.gauge_residual = next.reading - control_.offset - s.gauge.dot(s.jump) - reading_per_load_ * next.load;
  s.error =
      s.nodes.empty() ? 0.0 : (s.residual.array() / s.area.array()).abs().maxCoeff() / law_.surface.tensile_strength;
  return std::isfinite(s.error);
}

void MidLine::factorise(const System& s) {
  Eigen::MatrixXd a = s.stiffness;
  a.diagonal().array() += s.area.array() * s.tangent.array();
  a.noalias() += s.load * (s.gauge / reading_per_load_).transpose();
  lu_.compute(a);
  const auto negative = (lu_.matrixLU().diagonal().array() < 0.0).count();
  const bool odd = (negative % 2 == 1) != (lu_.permutationP().determinant() < 0);
  unique_ = !odd;
}

bool MidLine::newton(State& next, System& s) {
  constexpr int most_iterations = 60;
  constexpr double slow = 0.1;        // a residual that falls by less asks for a new tangent
  constexpr double good = 1e-9;       // of sigma_t0; from here on iterate as long as it helps
  constexpr double rounding = 1e-14;  // of sigma_t0
  if (s.nodes.empty()) {
    next.load = (next.reading - control_.offset) / reading_per_load_;
    unique_ = true;
    return true;
  }
  if (!evaluate(next, s)) return false;
  bool old = true;
  for (int k = 0; k < most_iterations; ++k) {
    if (old) factorise(s);
    const Eigen::VectorXd change = lu_.solve(s.residual + s.load * (s.gauge_residual / reading_per_load_));
    next.load += (s.gauge_residual - s.gauge.dot(change)) / reading_per_load_;
    s.jump += change;
    const double before = s.error;
    if (!evaluate(next, s)) return false;
    if (s.error <= rounding || (s.error <= good && s.error > 0.5 * before)) {
      for (std::size_t i = 0; i < s.nodes.size(); ++i) next.jump[s.nodes[i]] = s.jump[static_cast<Eigen::Index>(i)];
      return true;
    }
    old = s.error > slow * before;
  }
  return false;
}

bool MidLine::change_set(State& next, const System& s) const {
  constexpr double tolerance = 1e-9;
  const bool untouched = std::find(now_.cracked.begin(), now_.cracked.end(), true) == now_.cracked.end();
  if (untouched && s.nodes.empty() && next.load <= 0.0) return false;  // the elastic line goes on below zero
  const Eigen::VectorXd force = body_.body.load * next.load - stiffness_(Eigen::all, s.nodes) * s.jump;
  bool changed = false;
  for (std::size_t i = 0; i < next.cracked.size(); ++i) {
    const auto node = static_cast<Eigen::Index>(i);
    const bool crack =
        !next.cracked[i] && force[node] > body_.area[node] * law_.surface.tensile_strength * (1.0 + tolerance);
    const bool tie = next.cracked[i] && !now_.cracked[i] && next.jump[node] < 0.0;
    if (!crack && !tie) continue;
    next.cracked[i] = crack;
    next.jump[node] = 0.0;
    changed = true;
  }
  return changed;
}

void MidLine::set_rates(State& next, const System& s) const {
  next.jump_rate = Eigen::VectorXd::Zero(next.jump.size());
  next.load_rate = 1.0 / reading_per_load_;
  if (s.nodes.empty()) return;
  const Eigen::VectorXd rate = lu_.solve(s.load / reading_per_load_);
  next.load_rate = (1.0 - s.gauge.dot(rate)) / reading_per_load_;
  for (std::size_t i = 0; i < s.nodes.size(); ++i) next.jump_rate[s.nodes[i]] = rate[static_cast<Eigen::Index>(i)];
}

/// A jump over a snap-back ends far from the tangent prediction however small the step is.
bool MidLine::close_to_prediction(const State& next) const {
  constexpr double load_tolerance = 0.02;
  constexpr double jump_tolerance = 0.1;
  const double step = next.reading - now_.reading;
  const double load = now_.load + now_.load_rate * step;
  if (std::abs(next.load - load) > load_tolerance * std::max(largest_load_, std::abs(next.load))) return false;
  const Eigen::ArrayXd jump = now_.jump + now_.jump_rate * step;
  return ((next.jump.array() - jump).abs() <= jump_tolerance * (law_.softening.length() + next.jump.array().abs()))
      .all();
}

bool MidLine::differentiate(State& next, const System& s) {
  const auto m = static_cast<Eigen::Index>(s.nodes.size());
  const double e = young_modulus_;
  const CondensedBody& d_nu = *body_.d_nu;
  const int gauge = static_cast<int>(control_.gauge);

  // 1. Explicit derivatives of the gauge's equation, gauge + offset + compliance P - reading = 0.
  Inputs d_reading = Inputs::Zero();
  d_reading[at(PathInput::young_modulus)] = -body_.body.gauge_load[gauge] * next.load / (e * e);
  d_reading[at(PathInput::poisson_ratio)] =
      d_nu.gauge_jump.row(gauge).dot(next.jump) + d_nu.gauge_load[gauge] * next.load / e;
  d_reading[at(PathInput::gauge_offset)] = 1.0;
  d_reading[at(PathInput::machine_compliance)] = next.load;
  next.slopes = now_.slopes;
  next.load_derivatives = -d_reading / reading_per_load_;
  if (m == 0) return true;

  // 2. The same of the residuals; those of the traction come from the law, history included.
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(m, path_input_count);
  right.col(at(PathInput::young_modulus)) = -(s.stiffness * s.jump) / e;
  right.col(at(PathInput::poisson_ratio)) =
      d_nu.load(s.nodes) * next.load - e * (d_nu.stiffness(s.nodes, s.nodes) * s.jump);
  Eigen::VectorXd tangent(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto node = static_cast<std::size_t>(s.nodes[static_cast<std::size_t>(k)]);
    const SlopeZone begin = now_.cracked[node] ? now_.slopes[node] : fresh_zone<Slope>(slope_law_);
    law_status_ = open_zone(slope_law_, begin, Slope::seed(s.jump[k], own_jump), next.slopes[node]);
    if (law_status_ != Status::ok) return false;
    const auto& slope = next.slopes[node].traction[0].grad;
    right.row(k) -= s.area[k] * slope.head<path_input_count>().transpose();
    tangent[k] = slope[own_jump];
  }

  // 3. Implicit function theorem. The factor is of a tangent nearby; refinement makes up for that, or a new factor.
  constexpr double accuracy = 1e-11;
  constexpr int most_refinements = 3;
  right.noalias() -= s.load * (d_reading / reading_per_load_).transpose();
  const Eigen::RowVectorXd size = right.cwiseAbs().colwise().maxCoeff();
  const auto rest = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    return right - s.stiffness * x - (s.area.array() * tangent.array()).matrix().asDiagonal() * x -
           s.load * (s.gauge.transpose() * x / reading_per_load_);
  };
  Eigen::MatrixXd d_jump = lu_.solve(right);
  for (int k = 0; k <= most_refinements; ++k) {
    const Eigen::MatrixXd r = rest(d_jump);
    if ((r.cwiseAbs().colwise().maxCoeff().array() <= accuracy * size.array()).all()) break;
    if (k == most_refinements) {
      factorise(s);
      d_jump = lu_.solve(right);
    } else {
      d_jump += lu_.solve(r);
    }
  }
  next.load_derivatives -= (s.gauge.transpose() * d_jump / reading_per_load_).transpose();

  // 4. Derivatives of the zones, now along the path.
  for (Eigen::Index k = 0; k < m; ++k) {
    SlopeZone& z = next.slopes[static_cast<std::size_t>(s.nodes[static_cast<std::size_t>(k)])];
    for (Slope* x : {&z.traction[0], &z.jump[0], &z.plastic_jump[0], &z.offset[0], &z.integrity, &z.dissipated}) {
      x->grad.head<path_input_count>() += x->grad[own_jump] * d_jump.row(k).transpose();
      x->grad[own_jump] = 0.0;
    }
  }
  return true;
}

std::string MidLine::why_stuck(double wanted) const {
  std::ostringstream text;
  text << "no equilibrium at " << name(control_.gauge) << " = " << wanted << " m (reached " << now_.reading << " m): ";
  const bool through = std::find(now_.cracked.begin(), now_.cracked.end(), false) == now_.cracked.end();
  if (law_status_ == Status::no_plastic_flow) {
    text << "the dilation angle is 0, and without dilation pure opening has no solution";
  } else if (through) {
    text << "the crack has run through the whole ligament";
  } else {
    // The path is piecewise smooth: where no step however small leads on, it has turned back.
    text << "equilibrium turns back there (snap-back) at a load of " << now_.load << " N; ";
    if (is_opening(control_.gauge)) {
      text << "where theory has none, the process zone is too short for the mesh: make the elements smaller";
    } else {
      text << "use CMOD data, or smaller elements if the load has hardly begun to fall";
    }
  }
  return text.str();
}

double MidLine::gauge(Gauge which) const {
  const int k = static_cast<int>(which);
  return body_.body.gauge_jump.row(k).dot(now_.jump) + body_.body.gauge_load[k] * now_.load / young_modulus_;
}

Eigen::VectorXd MidLine::traction() const {
  return (body_.body.load * now_.load - stiffness_ * now_.jump).cwiseQuotient(body_.area);
}

double MidLine::fracture_work() const {
  double work = 0.0;
  for (std::size_t i = 0; i < now_.cracked.size(); ++i) {
    if (!now_.cracked[i]) continue;
    work += body_.area[static_cast<Eigen::Index>(i)] * (now_.zones[i].dissipated + free_energy(law_, now_.zones[i]));
  }
  return work;
}

double MidLine::elastic_energy() const {
  const double compliance = body_.body.gauge_load[static_cast<int>(Gauge::deflection_load_point)] / young_modulus_;
  return 0.5 * now_.jump.dot(stiffness_ * now_.jump) + 0.5 * compliance * now_.load * now_.load;
}

double MidLine::crack_length() const {
  double top = body_.height[0];
  for (std::size_t i = 0; i < now_.cracked.size(); ++i) {
    if (now_.cracked[i]) top = body_.height[static_cast<Eigen::Index>(i)];
  }
  return top - body_.height[0];
}

double MidLine::elastic_limit() const {
  const double most = (body_.body.load.array() / body_.area.array()).maxCoeff();
  return control_.offset + reading_per_load_ * law_.surface.tensile_strength / most;
}

}  // namespace fpz::calibration
