// What a stage prescribes, as N linear equations between the stored strains and stresses of a point, and their
// solution.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fpz/continuation.hpp"
#include "fpz/driver/dimension.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::driver {

/// One step of the point, as tried by a stage control.
struct Step {
  Report report;    ///< of the last update; status other than ok: the step failed
  int updates = 0;  ///< constitutive updates this took
  long iterations = 0;
  long substeps = 0;
};

/// Prescribes  strain . eps + stress . sig = from + s (to - from),  s in [0, 1] through the stage, on stored
/// components.
template <int Dim>
struct Equation {
  Tensor<double, Dim> strain = Tensor<double, Dim>::Zero();
  Tensor<double, Dim> stress = Tensor<double, Dim>::Zero();
  double from = 0.0;
  double to = 0.0;
  double scale = 1.0;  ///< size of the terms: residuals are relative to it

  [[nodiscard]] double residual(const State<double, Dim>& x, double s) const {
    return (strain.dot(x.strain) + stress.dot(x.stress) - (from + s * (to - from))) / scale;
  }
};

/// Mixed control of a stage. Components that no control mentions keep their strain; every linear constraint frees one
/// of those among its own.
template <int Dim>
class StageControl {
 public:
  static constexpr int N = tensor_size<Dim>;
  using Point = State<double, Dim>;
  using Strain = Tensor<double, Dim>;

  /// `begin` is the state at the begin of the stage. Throws InputError when the equations do not determine the strains.
  StageControl(const Material<double>& m, const Options& o, const Stage& stage, const Point& begin)
      : material_(m), options_(o) {
    stress_scale_ = m.law.tensile_strength;
    strain_scale_ = stress_scale_ / (m.bulk.lambda + 2.0 * m.bulk.mu);
    set_components(stage, begin);
    set_constraints(stage, begin);
    scale_equations(begin);
    if (stage.jump) {
      if (!strain_only_) throw InputError("jump control needs strain controls only: it scales their increments");
      jump_ = stage.jump->increment * stage.increments;
      for (int k = 0; k < N; ++k) direction_[k] = equations_[at(k)].to - equations_[at(k)].from;
      if (!(direction_.norm() > 0.0)) throw InputError("jump control needs a strain control that gives a direction");
    }
  }

  [[nodiscard]] bool strain_only() const { return strain_only_; }
  [[nodiscard]] bool jump_controlled() const { return jump_ > 0.0; }
  /// True when some prescribed stress (or stress combination) changes during the stage.
  [[nodiscard]] bool ramps_stress() const { return ramps_stress_; }
  [[nodiscard]] const Strain& direction() const { return direction_; }

  /// Takes the point from s0 to s1. `rate` is the last accepted d(strain)/ds, the first guess; it is updated on
  /// success.
  [[nodiscard]] Step step(const Point& begin, double s0, double s1, Strain& rate, Point& end) const {
    if (jump_controlled()) return jump_step(begin, s1 - s0, end);
    if (strain_only_) return strain_step(begin, s1, end);
    Step step = newton(begin, s1, Strain(rate * (s1 - s0)), end);
    if (!step.report.ok()) {
      Step again = newton(begin, s1, elastic_guess(begin, s1), end);
      again.updates += step.updates;
      again.iterations += step.iterations;
      again.substeps += step.substeps;
      step = again;
    }
    if (step.report.ok()) rate = (end.strain - begin.strain) / (s1 - s0);
    return step;
  }

 private:
  static constexpr double residual_tolerance = 1e-10;
  /// A mixed-control step with more damage than this is cut: after a limit point Newton may land on a far branch
  /// instead.
  static constexpr double largest_damage_step = 0.1;
  using Square = Mat<double, N, N>;

  [[nodiscard]] static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void set_components(const Stage& stage, const Point& begin) {
    for (int k = 0; k < N; ++k) {
      equations_[at(k)].strain[k] = 1.0;
      equations_[at(k)].from = equations_[at(k)].to = begin.strain[k];
    }
    for (const ComponentControl& c : stage.controls) {
      const int k = stored_index<Dim>(c.component);
      if (k < 0)
        throw InputError("component " + std::string(component_names[at(c.component)]) + " cannot be controlled in 2-D");
      Equation<Dim>& e = equations_[at(k)];
      taken_[at(k)] = true;
      if (c.control == Control::strain_increment) e.to = e.from + c.value * stage.increments;
      if (c.control == Control::strain) e.to = c.value;
      if (c.control == Control::stress) {
        e.strain[k] = 0.0;
        e.stress[k] = 1.0;
        e.from = begin.stress[k];
        e.to = c.value;
        strain_only_ = false;
        ramps_stress_ = ramps_stress_ || std::abs(e.to - e.from) > 1e-9 * stress_scale_;
      }
    }
  }

  /// Coefficients over the stored components: the out-of-plane ones of 2-D depend linearly on those in the plane.
  [[nodiscard]] Equation<Dim> stored_form(const LinearConstraint& c) const {
    Equation<Dim> e;
    for (int i = 0; i < 6; ++i) {
      if (const int k = stored_index<Dim>(i); k >= 0) {
        e.strain[k] = c.strain[at(i)];
        e.stress[k] = c.stress[at(i)];
      }
    }
    if constexpr (Dim == 2) {
      State<double, 2> unit;
      for (int k = 0; k < 2; ++k) {
        unit.stress.setZero();
        unit.stress[k] = 1.0;
        e.stress[k] += c.stress[2] * stress_zz(material_, unit) + c.strain[2] * strain_zz(material_, unit);
      }
    }
    return e;
  }

  void set_constraints(const Stage& stage, const Point& begin) {
    if (stage.constraints.empty()) return;
    std::vector<Equation<Dim>> found;
    for (const LinearConstraint& c : stage.constraints) {
      Equation<Dim> e = stored_form(c);
      e.from = e.strain.dot(begin.strain) + e.stress.dot(begin.stress);
      e.to = c.value;
      strain_only_ = false;
      ramps_stress_ =
          ramps_stress_ || (e.stress.norm() > 0.0 && std::abs(e.to - e.from) > 1e-9 * stress_scale_ * e.stress.norm());
      found.push_back(e);
    }
    std::array<int, 6> owner;
    owner.fill(-1);
    for (std::size_t i = 0; i < found.size(); ++i) {
      std::array<bool, 6> seen{};
      if (!assign(found, static_cast<int>(i), owner, seen)) {
        throw InputError("constraint " + std::to_string(i + 1) + ": no component is left free for it");
      }
    }
    for (int k = 0; k < N; ++k) {
      if (owner[at(k)] >= 0) equations_[at(k)] = found[at(owner[at(k)])];
    }
  }

  /// Gives constraint i a component of its own (augmenting paths of bipartite matching).
  [[nodiscard]] bool assign(const std::vector<Equation<Dim>>& found, int i, std::array<int, 6>& owner,
                            std::array<bool, 6>& seen) const {
    for (int k = 0; k < N; ++k) {
      const Equation<Dim>& e = found[at(i)];
      if (taken_[at(k)] || seen[at(k)] || (e.strain[k] == 0.0 && e.stress[k] == 0.0)) continue;
      seen[at(k)] = true;
      if (owner[at(k)] < 0 || assign(found, owner[at(k)], owner, seen)) {
        owner[at(k)] = i;
        return true;
      }
    }
    return false;
  }

  void scale_equations(const Point&) {
    for (Equation<Dim>& e : equations_) {
      e.scale = e.strain.cwiseAbs().sum() * strain_scale_ + e.stress.cwiseAbs().sum() * stress_scale_;
    }
    elastic_ = jacobian(elastic_tangent<Dim>(material_.bulk));
    elastic_determinant_ = elastic_.determinant();
    if (!(std::abs(elastic_determinant_) > 1e-12))
      throw InputError("the controls and constraints of the stage are not independent");
  }

  /// d(residual)/d(strain / strain_scale).
  [[nodiscard]] Square jacobian(const Tangent<Dim>& c) const {
    Square j;
    for (int k = 0; k < N; ++k) {
      const Equation<Dim>& e = equations_[at(k)];
      j.row(k) = (e.strain.transpose() + e.stress.transpose() * c) * (strain_scale_ / e.scale);
    }
    return j;
  }

  [[nodiscard]] Strain residual(const Point& x, double s) const {
    Strain r;
    for (int k = 0; k < N; ++k) r[k] = equations_[at(k)].residual(x, s);
    return r;
  }

  [[nodiscard]] Strain elastic_guess(const Point& begin, double s1) const {
    return Strain(elastic_.partialPivLu().solve(-residual(begin, s1)) * strain_scale_);
  }

  [[nodiscard]] Step strain_step(const Point& begin, double s1, Point& end) const {
    Strain d;
    for (int k = 0; k < N; ++k) {
      const Equation<Dim>& e = equations_[at(k)];
      d[k] = (s1 == 1.0 ? e.to : e.from + s1 * (e.to - e.from)) - begin.strain[k];
    }
    Step step;
    step.report = update<Dim>(material_, options_, begin, d, end);
    count(step, step.report);
    return step;
  }

  [[nodiscard]] Step jump_step(const Point& begin, double ds, Point& end) const {
    Step step;
    double load_factor = 0.0;
    step.report = update_controlled<Dim>(material_, options_, begin, direction_, jump_ * ds, end, load_factor);
    count(step, step.report);
    return step;
  }

  static void count(Step& step, const Report& r) {
    ++step.updates;
    step.iterations += r.iterations;
    step.substeps += r.substeps;
  }

  /// Newton with line search on the strain increment; the merit is the norm of the scaled residual.
  [[nodiscard]] Step newton(const Point& begin, double s1, Strain d, Point& end) const {
    Step step;
    Tangent<Dim> c;
    Point trial;
    step.report = update_with_tangent<Dim>(material_, options_, begin, d, trial, c);
    count(step, step.report);
    if (!step.report.ok()) return step;
    Strain r = residual(trial, s1);
    for (int k = 0; k < 40; ++k) {
      if (!(r.norm() > residual_tolerance)) return accept(step, begin, trial, c, end);
      const Strain move = jacobian(c).partialPivLu().solve(-r) * strain_scale_;
      if (!is_finite(move)) break;
      double length = 1.0;
      bool better = false;
      for (; length > 1e-4 && !better; length *= 0.5) {
        Point next;
        Tangent<Dim> next_c;
        const Report report =
            update_with_tangent<Dim>(material_, options_, begin, Strain(d + length * move), next, next_c);
        count(step, report);
        if (!report.ok()) continue;
        const Strain next_r = residual(next, s1);
        if (next_r.norm() >= (1.0 - 1e-4 * length) * r.norm()) continue;
        better = true;
        d += length * move;
        trial = next;
        c = next_c;
        r = next_r;
        step.report = report;
      }
      // The adaptive integrator changes its steps with the strain, so its result has steps of their own size, far below
      // its tolerance.
      if (!better) {
        if (r.norm() <= std::max(residual_tolerance, 0.01 * options_.tolerance))
          return accept(step, begin, trial, c, end);
        break;
      }
    }
    step.report.status = Status::non_convergence;
    return step;
  }

  /// Takes a converged step unless it lies beyond a limit point, where the determinant has changed its sign.
  [[nodiscard]] Step accept(Step step, const Point& begin, const Point& trial, const Tangent<Dim>& c,
                            Point& end) const {
    if (jacobian(c).determinant() / elastic_determinant_ <= 0.0) {
      step.report.status = Status::snap_back;
    } else if (damage(trial) - damage(begin) > largest_damage_step) {
      step.report.status = Status::non_convergence;
    } else {
      end = trial;
    }
    return step;
  }

  const Material<double>& material_;
  const Options& options_;
  std::array<Equation<Dim>, static_cast<std::size_t>(N)> equations_;
  std::array<bool, 6> taken_{};
  Square elastic_;
  double elastic_determinant_ = 0.0;
  double stress_scale_ = 1.0;
  double strain_scale_ = 1.0;
  bool strain_only_ = true;
  bool ramps_stress_ = false;
  double jump_ = 0.0;  ///< kappa over the whole stage, m
  Strain direction_ = Strain::Zero();
};

}  // namespace fpz::driver
