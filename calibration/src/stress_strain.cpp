#include "fpz/calibration/stress_strain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "admissible.hpp"
#include "fpz/driver/dimension.hpp"
#include "fpz/driver/stage_equations.hpp"
#include "fpz/driver/trace.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update_any_scalar.hpp"
#include "jet.hpp"
#include "words.hpp"

namespace fpz::calibration {
namespace {

/// Ends a prediction with a reason.
class NoPrediction : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Enough digits to find the value again in the input.
std::string number(double x) { return detail::number(x, 8); }

/// One component of a state, derived ones included.
template <int Dim, class T, class P>
T observe(const Material<P>& m, const State<T, Dim>& s, const TensorComponent& what) {
  const bool strain = what.kind == TensorKind::strain;
  const int k = driver::stored_index<Dim>(what.component);
  if (k >= 0) return strain ? s.strain[k] : s.stress[k];
  if constexpr (Dim == 2) {
    if (what.component == 2) return strain ? strain_zz(m, s) : stress_zz(m, s);
  }
  return T(0.0);
}

/// A point of the path: fraction s of the stage, inside the step of that index.
struct Place {
  std::size_t step = 0;
  double s = 0.0;
};

template <int Dim>
class CurveRun {
 public:
  using Point = State<double, Dim>;
  using Strain = Tensor<double, Dim>;
  using JetPoint = State<Jet, Dim>;

  CurveRun(const StressStrainTest& test, const driver::Test& path)
      : test_(test),
        path_(path),
        material_(make_material(path.parameters, path.setting)),
        trace_(driver::trace_test<Dim>(path)) {
    if (trace_.steps.empty()) throw NoPrediction(trace_.result.message);
  }

  [[nodiscard]] Prediction predict(bool derivatives) {
    std::vector<Place> places;
    for (const double x : test_.points) places.push_back(test_.abscissa_strain ? place_at_strain(x) : place_at_time(x));
    Prediction out;
    const auto n = static_cast<Eigen::Index>(places.size());
    out.values.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      out.values[i] = observe(material_, at(places[static_cast<std::size_t>(i)]), test_.ordinate);
    }
    if (derivatives) differentiate(places, out);
    return out;
  }

 private:
  using Step = driver::TracedStep<Dim>;

  // --- where a point lies ---

  [[nodiscard]] double end_of_run() const { return trace_.steps.back().stage + trace_.steps.back().s1; }

  [[noreturn]] void beyond(const std::string& point) const {
    if (!trace_.result.ok()) throw NoPrediction(point + " is not reached: " + trace_.result.message);
    throw NoPrediction(point + " lies outside the path, which ends at time " + number(end_of_run()));
  }

  /// Throws where the path to this step cannot be repeated at other parameters.
  [[nodiscard]] Place checked(Place p, const std::string& point) const {
    const int stage = trace_.steps[p.step].stage;
    for (int k = 0; k <= stage; ++k) {
      if (path_.stages[static_cast<std::size_t>(k)].jump) {
        throw NoPrediction(point + " needs stage " + std::to_string(k + 1) +
                           ", which is under jump control; the calibration follows strain and stress control only. Use "
                           "strain control with a smaller rve_length");
      }
    }
    for (std::size_t i = 0; i + 1 < trace_.steps.size() && trace_.steps[i].stage < stage; ++i) {
      if (trace_.steps[i + 1].stage > trace_.steps[i].stage && trace_.steps[i].s1 < 1.0) {
        throw NoPrediction(point + " lies behind stage " + std::to_string(trace_.steps[i].stage + 1) +
                           ", which a stop condition ended at a place that depends on the parameters. Prescribe the "
                           "strain or stress at which the stage ends instead");
      }
    }
    return p;
  }

  [[nodiscard]] Place place_at_time(double time) const {
    const std::string point = "the point at time " + number(time);
    if (!(time >= 0.0)) beyond(point);
    for (std::size_t i = 0; i < trace_.steps.size(); ++i) {
      const Step& step = trace_.steps[i];
      if (time <= step.stage + step.s1) {
        if (time < step.stage + step.s0) {
          throw NoPrediction(point + " lies in the part of a stage that its stop condition cut off");
        }
        return checked({i, time - step.stage}, point);
      }
    }
    beyond(point);
  }

  [[nodiscard]] double strain(const Point& p) const {
    return observe(material_, p, {TensorKind::strain, *test_.abscissa_strain});
  }

  [[nodiscard]] Place place_at_strain(double x) const {
    const std::string name = "eps_" + std::string(driver::component_names[index(*test_.abscissa_strain)]);
    const std::string point = "the point at " + name + " = " + number(x);
    const auto [from, to] = test_.window.value_or(std::pair(0.0, 1e300));
    double least = 1e300;
    double most = -1e300;
    double sense = 0.0;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < trace_.steps.size(); ++i) {
      const Step& step = trace_.steps[i];
      if (step.stage + step.s0 < from - 1e-12 || step.stage + step.s1 > to + 1e-12) continue;
      const double a = strain(step.begin);
      const double b = strain(step.end);
      if (a == b || (b - a) * sense < 0.0) {
        throw NoPrediction(name + " turns round or rests at time " + number(step.stage + step.s0) +
                           ", so it does not name one point. Give the path times between which the points lie, or use "
                           "the path time as abscissa");
      }
      sense = b - a;
      least = std::min({least, a, b});
      most = std::max({most, a, b});
      if ((x - a) * (x - b) <= 0.0 && !found) found = i;
    }
    if (!found) {
      if (!(least <= most)) throw NoPrediction("no increment of the path lies between the times of the window");
      const std::string range = " (" + name + " runs from " + number(least) + " to " + number(most) + ")";
      beyond(point + range);
    }
    return checked({*found, fraction_at_strain(*found, x)}, point);
  }

  /// The fraction of the stage at which a step meets a strain; at once where that strain is prescribed.
  [[nodiscard]] double fraction_at_strain(std::size_t i, double x) const {
    const Step& step = trace_.steps[i];
    double lo = step.s0;
    double hi = step.s1;
    double e_lo = strain(step.begin) - x;
    double e_hi = strain(step.end) - x;
    const double size = std::abs(e_hi - e_lo);
    double s = hi;
    int side = 0;
    for (int k = 0; k < 100; ++k) {
      s = (e_lo * hi - e_hi * lo) / (e_lo - e_hi);
      const double e = strain(at({i, s})) - x;
      if (std::abs(e) <= 1e-13 * size || hi - lo <= 1e-15) break;
      if ((e < 0.0) == (e_lo < 0.0)) {
        lo = s;
        e_lo = e;
        if (side == -1) e_hi *= 0.5;
        side = -1;
      } else {
        hi = s;
        e_hi = e;
        if (side == 1) e_lo *= 0.5;
        side = 1;
      }
    }
    return s;
  }

  // --- states in between ---

  [[nodiscard]] static std::size_t index(int k) { return static_cast<std::size_t>(k); }

  [[nodiscard]] const driver::Stage& stage(const Step& step) const { return path_.stages[index(step.stage)]; }

  /// The first state of the stage that a step belongs to.
  [[nodiscard]] const Point& begin_of_stage(std::size_t i) const {
    while (i > 0 && trace_.steps[i - 1].stage == trace_.steps[i].stage) --i;
    return trace_.steps[i].begin;
  }

  [[nodiscard]] Point at(const Place& p) const {
    const Step& step = trace_.steps[p.step];
    if (p.s == step.s0) return step.begin;
    if (p.s == step.s1) return step.end;
    const driver::StageEquations<Dim> equations(material_, stage(step), begin_of_stage(p.step));
    return follow(material_, equations, step.begin, p.s, increment_to(equations, step, p.s));
  }

  /// The strain increment from the begin of a step to s, by Newton's method from the proportional part of the step.
  [[nodiscard]] Strain increment_to(const driver::StageEquations<Dim>& equations, const Step& step, double s) const {
    Strain d = (step.end.strain - step.begin.strain) * ((s - step.s0) / (step.s1 - step.s0));
    if (s == step.s1 || equations.strain_only()) return d;
    double last = 1e300;
    for (int k = 0; k < 30; ++k) {
      Point end;
      const Tangent<Dim> c = tangent(step.begin, d, end);
      const Strain r = equations.residual(end, s);
      if (r.norm() <= 1e-10 || (k > 3 && r.norm() >= last && r.norm() <= 0.01 * path_.options.tolerance)) return d;
      last = r.norm();
      d -= equations.jacobian(c).partialPivLu().solve(r) * equations.strain_scale();
    }
    throw NoPrediction("no equilibrium found at time " + number(step.stage + s) +
                       " between two increments of the path. Use more increments");
  }

  [[nodiscard]] Tangent<Dim> tangent(const Point& begin, const Strain& d, Point& end) const {
    Tangent<Dim> c;
    const Report report = update_with_tangent<Dim>(material_, path_.options, begin, d, end, c);
    if (!report.ok()) throw NoPrediction(std::string("a step cannot be repeated: ") + to_string(report.status));
    return c;
  }

  /// The state at s of the stage, from `begin`, with derivatives. `d` is the strain increment in plain numbers; what
  /// else it depends on follows from the equations, where stresses are prescribed with one Newton step on the
  /// consistent tangent.
  template <class T, class P>
  [[nodiscard]] State<T, Dim> follow(const Material<P>& m, const driver::StageEquations<Dim, T>& equations,
                                     const State<T, Dim>& begin, const T& s, const Strain& d) const {
    Tensor<T, Dim> increment = convert<T>(d);
    if (equations.strain_only()) {
      increment = equations.strain_at(s) - begin.strain;
    } else if constexpr (!std::is_same_v<T, double>) {
      Point end;
      const Point plain = lifted<double>(begin);
      const auto factors = equations.jacobian(tangent(plain, d, end)).partialPivLu();
      const Tensor<T, Dim> r = equations.residual(updated(m, begin, increment), s);
      const Strain unit_scale = Strain::Constant(equations.strain_scale());
      const Mat<double, Tensor<double, Dim>::RowsAtCompileTime, Tensor<double, Dim>::RowsAtCompileTime> inverse =
          factors.inverse();
      for (int i = 0; i < tensor_size<Dim>; ++i) {
        for (int j = 0; j < tensor_size<Dim>; ++j) increment[i] -= (inverse(i, j) * unit_scale[i]) * r[j];
      }
    }
    return updated(m, begin, increment);
  }

  template <class T, class P>
  [[nodiscard]] State<T, Dim> updated(const Material<P>& m, const State<T, Dim>& begin,
                                      const Tensor<T, Dim>& increment) const {
    State<T, Dim> end;
    const Report report = update<Dim>(m, path_.options, begin, increment, end);
    if (!report.ok()) throw NoPrediction(std::string("a step cannot be repeated: ") + to_string(report.status));
    return end;
  }

  template <class To, class From>
  [[nodiscard]] static State<To, Dim> lifted(const State<From, Dim>& a) {
    State<To, Dim> b;
    b.strain = convert<To>(a.strain);
    b.stress = convert<To>(a.stress);
    b.cracked = a.cracked;
    b.frame = convert<To>(a.frame);
    b.crack = lift<To>(a.crack);
    return b;
  }

  // --- derivatives ---

  /// Repeats all steps up to the last point, and enters those that have points inside.
  void differentiate(const std::vector<Place>& places, Prediction& out) const {
    out.jacobian.resize(out.values.size(), parameter_count);
    BasicParameters<Jet> parameters = seeded(path_.parameters);
    const Material<Jet> m = make_material(parameters, path_.setting);
    std::vector<std::size_t> order(places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return places[a].step < places[b].step; });
    JetPoint now;
    std::optional<driver::StageEquations<Dim, Jet>> equations;
    auto next = order.begin();
    for (std::size_t i = 0; i < trace_.steps.size() && next != order.end(); ++i) {
      const Step& step = trace_.steps[i];
      if (i == 0 || trace_.steps[i - 1].stage != step.stage) equations.emplace(m, stage(step), now);
      for (; next != order.end() && places[*next].step == i; ++next) {
        out.jacobian.row(static_cast<Eigen::Index>(*next)) = derivative_at(m, *equations, now, places[*next]);
      }
      if (next == order.end()) break;
      now = follow(m, *equations, now, Jet(step.s1), Strain(step.end.strain - step.begin.strain));
    }
  }

  [[nodiscard]] Eigen::RowVectorXd derivative_at(const Material<Jet>& m,
                                                 const driver::StageEquations<Dim, Jet>& equations,
                                                 const JetPoint& begin, const Place& p) const {
    const Step& step = trace_.steps[p.step];
    const driver::StageEquations<Dim> plain(material_, stage(step), begin_of_stage(p.step));
    const Strain d = increment_to(plain, step, p.s);
    JetPoint there = follow(m, equations, begin, Jet(p.s), d);
    if (test_.abscissa_strain) {
      // The point lies at a given strain, so its place in the stage depends on the parameters too.
      const TensorComponent abscissa{TensorKind::strain, *test_.abscissa_strain};
      const Jet e = observe(m, there, abscissa);
      if (e.v.squaredNorm() > 0.0) {
        using D = Dual<1>;
        const driver::StageEquations<Dim, D> moving(material_, stage(step), lifted<D>(begin_of_stage(p.step)));
        const State<D, Dim> path = follow(material_, moving, lifted<D>(step.begin), D::seed(p.s, 0), d);
        Jet s(p.s);
        s.v = -e.v / observe(material_, path, abscissa).grad[0];
        there = follow(m, equations, begin, s, d);
      }
    }
    return observe(m, there, test_.ordinate).v.transpose();
  }

  const StressStrainTest& test_;
  const driver::Test& path_;
  Material<double> material_;
  driver::Trace<Dim> trace_;
};

std::string problem(const StressStrainTest& test) {
  if (test.path.stages.empty()) return "the path has no stages";
  const auto known = [](int component) { return component >= 0 && component < 6; };
  if (!known(test.ordinate.component) || (test.abscissa_strain && !known(*test.abscissa_strain))) {
    return "a tensor component is not one of xx, yy, zz, xy, xz, yz";
  }
  for (const double x : test.points) {
    if (!std::isfinite(x)) return "the abscissa of a point is not a number";
  }
  return {};
}

}  // namespace

Prediction predict(const StressStrainTest& test, const Parameters& parameters, bool derivatives) {
  if (std::string why = problem(test); !why.empty()) return failed(std::move(why));
  driver::Test path = test.path;
  path.parameters = parameters;
  path.parameters.rve_length = test.path.parameters.rve_length;
  if (std::string why = why_inadmissible(path.parameters, path.setting, true); !why.empty()) {
    return failed(std::move(why));
  }
  try {
    return driver::with_dimension(
        path.setting, [&](auto dim) { return CurveRun<decltype(dim)::value>(test, path).predict(derivatives); });
  } catch (const NoPrediction& e) {
    return failed(e.what());
  } catch (const driver::InputError& e) {
    return failed(e.what());
  }
}

}  // namespace fpz::calibration
