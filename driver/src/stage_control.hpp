// One step of a material point under the control of a stage: strains, mixed strains and stresses, or jump.
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fpz/driver/stage_equations.hpp"
#include "fpz/jump_control.hpp"
#include "fpz/update.hpp"

namespace fpz::driver {

/// One step of the point, as tried by a stage control.
struct Step {
  Report report;    ///< of the last update; status other than ok: the step failed
  int updates = 0;  ///< constitutive updates this took
  long iterations = 0;
  long substeps = 0;
};

/// Takes a point through a stage by solving its equations (stage_equations.hpp).
template <int Dim>
class StageControl {
 public:
  static constexpr int N = tensor_size<Dim>;
  using Point = State<double, Dim>;
  using Strain = Tensor<double, Dim>;

  /// `begin` is the state at the begin of the stage. Throws InputError when the equations do not determine the strains.
  StageControl(const Material<double>& m, const Options& o, const Stage& stage, const Point& begin)
      : material_(m),
        options_(o),
        equations_(m, stage, begin),
        elastic_determinant_(equations_.elastic_jacobian().determinant()) {
    if (stage.jump) {
      if (!strain_only()) throw InputError("jump control needs strain controls only: it scales their increments");
      jump_ = stage.jump->increment * stage.increments;
      direction_ = equations_.strain_range();
      if (!(direction_.norm() > 0.0)) throw InputError("jump control needs a strain control that gives a direction");
    }
  }

  [[nodiscard]] bool strain_only() const { return equations_.strain_only(); }
  [[nodiscard]] bool jump_controlled() const { return jump_ > 0.0; }
  /// True when some prescribed stress (or stress combination) changes during the stage.
  [[nodiscard]] bool ramps_stress() const { return equations_.ramps_stress(); }
  [[nodiscard]] const Strain& direction() const { return direction_; }

  /// Takes the point from s0 to s1. `rate` is the last accepted d(strain)/ds, the first guess; it is updated on
  /// success.
  [[nodiscard]] Step step(const Point& begin, double s0, double s1, Strain& rate, Point& end) const {
    if (jump_controlled()) return jump_step(begin, s1 - s0, end);
    if (strain_only()) return strain_step(begin, s1, end);
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

  [[nodiscard]] Strain elastic_guess(const Point& begin, double s1) const {
    return Strain(equations_.elastic_jacobian().partialPivLu().solve(-equations_.residual(begin, s1)) *
                  equations_.strain_scale());
  }

  [[nodiscard]] Step strain_step(const Point& begin, double s1, Point& end) const {
    const Strain d = equations_.strain_at(s1) - begin.strain;
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
    Strain r = equations_.residual(trial, s1);
    for (int k = 0; k < 40; ++k) {
      if (!(r.norm() > residual_tolerance)) return accept(step, begin, trial, c, end);
      const Strain move = equations_.jacobian(c).partialPivLu().solve(-r) * equations_.strain_scale();
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
        const Strain next_r = equations_.residual(next, s1);
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
    if (equations_.jacobian(c).determinant() / elastic_determinant_ <= 0.0) {
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
  StageEquations<Dim> equations_;
  double elastic_determinant_;
  double jump_ = 0.0;  ///< kappa over the whole stage, m
  Strain direction_ = Strain::Zero();
};

}  // namespace fpz::driver
