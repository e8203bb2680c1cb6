// The point at the begin of a step, from what a client keeps of it.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "behaviour_data.hpp"
#include "components.hpp"
#include "fpz/coupling.hpp"
#include "fpz/onset.hpp"
#include "fpz/point/behaviour.hpp"
#include "lists.hpp"

namespace fpz::generic {

template <int Dim>
struct BeginPoint {
  State<double, Dim> state;
  double axial_stress = 0.0;  ///< 2-D: sigma_zz beyond what the plane and the strain along z make, Pa
};

namespace detail {

/// Largest component in size.
template <class V>
[[nodiscard]] double size_of(const V& v) {
  return v.cwiseAbs().maxCoeff();
}

/// Where the rounding of strain and jump is felt in stresses, Pa.
template <int Dim>
[[nodiscard]] double rounding(const point::Behaviour& b, const State<double, Dim>& s) {
  const double jump = s.cracked ? size_of(s.crack.jump) * b.material.inverse_length : 0.0;
  return 1e-12 * (b.parameters.young_modulus * (size_of(s.strain) + jump) + size_of(s.stress));
}

/// A stress at the begin that the strain does not explain is an initial stress. It may not lie beyond the strength, and
/// across a crack it must be the traction that the crack has.
template <int Dim>
void check_initial_stress(const point::Behaviour& b, const State<double, Dim>& s) {
  const double strength = b.parameters.tensile_strength;
  if (!s.cracked) {
    if (find_plane<Dim>(b.material, b.options, s.stress).failure_value <= 1e-6 * strength) return;
    throw std::invalid_argument(
        "invalid_input: the stress at the begin of the step is an initial stress (it is not that of the strain) and "
        "lies beyond the strength: start from a smaller one and load the point");
  }
  const Vec<double, Dim> traction = local_traction<double, Dim>(s.frame, s.stress);
  const Vec<double, Dim> difference = traction - s.crack.traction;
  if (size_of(difference) <= 1e-3 * (strength + size_of(traction))) return;
  throw std::invalid_argument(
      "invalid_input: the stress at the begin of the step does not act on the crack as the internal state variables "
      "say: stress, strain and internal state variables must be those of one end of a step");
}

}  // namespace detail

/// Reads s0. The stress at the begin is what counts: where the strain does not explain it, within rounding, the
/// difference is an initial stress, and the strain of the point is the client's and the elastic strain of that stress.
/// Throws std::invalid_argument with what is wrong.
template <int Dim>
[[nodiscard]] BeginPoint<Dim> begin_point(const point::Behaviour& b, const BeginState& s0) {
  double flat[point::state_size<Dim>] = {};
  std::copy_n(s0.internal_state_variables, internal_count<Dim>, flat + kept_by_client<Dim>);
  BeginPoint<Dim> p;
  State<double, Dim>& s = p.state;
  if (!point::load<Dim>(flat, 1, s)) {
    throw std::invalid_argument(
        "invalid_input: the internal state variables are not a state that this behaviour wrote (\"cracked\" is 0 or 1, "
        "the frame is a rotation, the integrity is between 0 and 1): averaged, or transferred between meshes");
  }
  s.strain = model_strain<Dim>(b, s0.gradients);
  s.stress = model_stress<Dim>(s0.thermodynamic_forces);
  if (!is_finite(s.strain) || !is_finite(s.stress)) {
    throw std::invalid_argument("invalid_input: the strain or the stress at the begin of the step is not finite");
  }
  const double rounding = detail::rounding<Dim>(b, s);
  const Tensor<double, Dim> initial = s.stress - fpz::detail::macro_stress(b.material, s);
  if (detail::size_of(initial) > rounding) {
    detail::check_initial_stress<Dim>(b, s);
    s.strain += elastic_strain<Dim>(b.material.bulk, initial);
  }
  if constexpr (Dim == 2) {
    const double* force = s0.thermodynamic_forces;
    const double explained = axial_ratio(b) * (force[0] + force[1]) + axial_modulus(b) * s0.gradients[2];
    p.axial_stress = force[2] - explained;
    if (std::abs(p.axial_stress) <= rounding + 1e-12 * std::abs(explained)) p.axial_stress = 0.0;
    if (b.setting == Setting::plane_stress && p.axial_stress != 0.0) {
      throw std::invalid_argument("invalid_input: plane stress with a stress along z at the begin of the step");
    }
  }
  return p;
}

}  // namespace fpz::generic
