// What a stage prescribes, as N linear equations between the stored strains and stresses of a point.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "fpz/driver/dimension.hpp"
#include "fpz/driver/path_file.hpp"
#include "fpz/energy.hpp"
#include "fpz/tangent.hpp"

namespace fpz::driver {

/// Prescribes  strain . eps + stress . sig = from + s (to - from),  s in [0, 1] through the stage, on stored
/// components.
template <int Dim, class T = double>
struct Equation {
  Tensor<T, Dim> strain = Tensor<T, Dim>::Constant(T(0.0));
  Tensor<T, Dim> stress = Tensor<T, Dim>::Constant(T(0.0));
  T from = T(0.0);
  T to = T(0.0);
  double scale = 1.0;  ///< size of the terms: residuals are relative to it

  [[nodiscard]] T target(const T& s) const {
    return value(s) == 1.0 ? T(to + (s - 1.0) * (to - from)) : T(from + s * (to - from));
  }

  [[nodiscard]] T residual(const State<T, Dim>& x, const T& s) const {
    T sum = -target(s);
    for (int k = 0; k < tensor_size<Dim>; ++k) sum += strain[k] * x.strain[k] + stress[k] * x.stress[k];
    return sum / scale;
  }
};

/// Mixed control of a stage. Components that no control mentions keep their strain; every linear constraint frees one
/// of those among its own. T may carry derivatives: of the state at the begin of the stage, and with those of the
/// material also of what follows from it (out-of-plane components of constraints).
template <int Dim, class T = double>
class StageEquations {
 public:
  static constexpr int N = tensor_size<Dim>;
  using Square = Mat<double, N, N>;

  /// `begin` is the state at the begin of the stage. Throws InputError when the equations do not determine the strains.
  template <class P>
  StageEquations(const Material<P>& m, const Stage& stage, const State<T, Dim>& begin)
      : stress_scale_(value(m.law.surface.tensile_strength)),
        strain_scale_(stress_scale_ / (value(m.bulk.lambda) + 2.0 * value(m.bulk.mu))) {
    set_components(stage, begin);
    set_constraints(m, stage, begin);
    scale_equations(m);
  }

  [[nodiscard]] bool strain_only() const { return strain_only_; }
  /// True when some prescribed stress (or stress combination) changes during the stage.
  [[nodiscard]] bool ramps_stress() const { return ramps_stress_; }
  /// The strain at s when only strains are prescribed.
  [[nodiscard]] Tensor<T, Dim> strain_at(const T& s) const {
    Tensor<T, Dim> e;
    for (int k = 0; k < N; ++k) e[k] = equations_[at(k)].target(s);
    return e;
  }
  /// Change of those strains over the stage.
  [[nodiscard]] Tensor<T, Dim> strain_range() const {
    Tensor<T, Dim> e;
    for (int k = 0; k < N; ++k) e[k] = equations_[at(k)].to - equations_[at(k)].from;
    return e;
  }

  /// What is missing at a state, relative to the size of each equation's terms.
  [[nodiscard]] Tensor<T, Dim> residual(const State<T, Dim>& x, const T& s) const {
    Tensor<T, Dim> r;
    for (int k = 0; k < N; ++k) r[k] = equations_[at(k)].residual(x, s);
    return r;
  }

  /// d(residual)/d(strain / strain_scale()) with the tangent c.
  [[nodiscard]] Square jacobian(const Tangent<Dim>& c) const {
    Square j;
    for (int k = 0; k < N; ++k) {
      const Equation<Dim, T>& e = equations_[at(k)];
      const Tensor<double, Dim> strain = convert<double>(e.strain);
      const Tensor<double, Dim> stress = convert<double>(e.stress);
      j.row(k) = (strain.transpose() + stress.transpose() * c) * (strain_scale_ / e.scale);
    }
    return j;
  }
  /// The same with the elastic tangent.
  [[nodiscard]] const Square& elastic_jacobian() const { return elastic_; }
  [[nodiscard]] double strain_scale() const { return strain_scale_; }

 private:
  [[nodiscard]] static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  void set_components(const Stage& stage, const State<T, Dim>& begin) {
    for (int k = 0; k < N; ++k) {
      equations_[at(k)].strain[k] = T(1.0);
      equations_[at(k)].from = equations_[at(k)].to = begin.strain[k];
    }
    for (const ComponentControl& c : stage.controls) {
      const int k = stored_index<Dim>(c.component);
      if (k < 0)
        throw InputError("component " + std::string(component_names[at(c.component)]) + " cannot be controlled in 2-D");
      Equation<Dim, T>& e = equations_[at(k)];
      taken_[at(k)] = true;
      if (c.prescribed == Prescribed::strain_increment) e.to = e.from + c.value * stage.increments;
      if (c.prescribed == Prescribed::strain) e.to = T(c.value);
      if (c.prescribed == Prescribed::stress) {
        e.strain[k] = T(0.0);
        e.stress[k] = T(1.0);
        e.from = begin.stress[k];
        e.to = T(c.value);
        strain_only_ = false;
        ramps_stress_ = ramps_stress_ || std::abs(value(e.to) - value(e.from)) > 1e-9 * stress_scale_;
      }
    }
  }

  /// Coefficients over the stored components: the out-of-plane ones of 2-D depend linearly on those in the plane.
  template <class P>
  [[nodiscard]] Equation<Dim, T> stored_form(const Material<P>& m, const LinearConstraint& c) const {
    Equation<Dim, T> e;
    for (int i = 0; i < 6; ++i) {
      if (const int k = stored_index<Dim>(i); k >= 0) {
        e.strain[k] = T(c.strain[at(i)]);
        e.stress[k] = T(c.stress[at(i)]);
      }
    }
    if constexpr (Dim == 2) {
      State<T, 2> unit;
      for (int k = 0; k < 2; ++k) {
        unit.stress = Tensor<T, 2>::Constant(T(0.0));
        unit.stress[k] = T(1.0);
        e.stress[k] += c.stress[2] * stress_zz(m, unit) + c.strain[2] * strain_zz(m, unit);
      }
    }
    return e;
  }

  template <class P>
  void set_constraints(const Material<P>& m, const Stage& stage, const State<T, Dim>& begin) {
    if (stage.constraints.empty()) return;
    std::vector<Equation<Dim, T>> found;
    for (const LinearConstraint& c : stage.constraints) {
      Equation<Dim, T> e = stored_form(m, c);
      e.from = T(0.0);
      for (int k = 0; k < N; ++k) e.from += e.strain[k] * begin.strain[k] + e.stress[k] * begin.stress[k];
      const double stress_size = convert<double>(e.stress).norm();
      e.to = T(c.value);
      strain_only_ = false;
      ramps_stress_ = ramps_stress_ ||
                      (stress_size > 0.0 && std::abs(value(e.to) - value(e.from)) > 1e-9 * stress_scale_ * stress_size);
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
  [[nodiscard]] bool assign(const std::vector<Equation<Dim, T>>& found, int i, std::array<int, 6>& owner,
                            std::array<bool, 6>& seen) const {
    for (int k = 0; k < N; ++k) {
      const Equation<Dim, T>& e = found[at(i)];
      if (taken_[at(k)] || seen[at(k)] || (value(e.strain[k]) == 0.0 && value(e.stress[k]) == 0.0)) continue;
      seen[at(k)] = true;
      if (owner[at(k)] < 0 || assign(found, owner[at(k)], owner, seen)) {
        owner[at(k)] = i;
        return true;
      }
    }
    return false;
  }

  template <class P>
  void scale_equations(const Material<P>& m) {
    for (Equation<Dim, T>& e : equations_) {
      e.scale = convert<double>(e.strain).cwiseAbs().sum() * strain_scale_ +
                convert<double>(e.stress).cwiseAbs().sum() * stress_scale_;
    }
    elastic_ = jacobian(elastic_tangent<Dim>(m.bulk));
    if (!(std::abs(elastic_.determinant()) > 1e-12))
      throw InputError("the controls and constraints of the stage are not independent");
  }

  std::array<Equation<Dim, T>, static_cast<std::size_t>(N)> equations_;
  std::array<bool, 6> taken_{};
  Square elastic_;
  double stress_scale_;
  double strain_scale_;
  bool strain_only_ = true;
  bool ramps_stress_ = false;
};

}  // namespace fpz::driver
