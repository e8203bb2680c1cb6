// The functions that a client calls: one for each modelling hypothesis.
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "begin_point.hpp"
#include "behaviour_data.hpp"
#include "fpz/point/point_update.hpp"
#include "operators.hpp"
#include "request.hpp"
#include "settings.hpp"

namespace fpz::generic {

namespace {

/// The part of the step with which a client should try again.
constexpr double smaller_step = 0.25;

/// Says why.
int fail(const BehaviourData& d, const char* why) noexcept {
  if (d.error_message != nullptr) std::snprintf(d.error_message, message_size, "%s: %s", behaviour_name, why);
  return failed;
}

/// Leaves s1 as s0, so that a client that goes on after a failure has a sound state.
template <int Dim>
void restore(const BehaviourData& d) noexcept {
  const auto copy = [](const double* from, double* to, std::size_t count) {
    if (from == nullptr || to == nullptr) return;
    for (std::size_t k = 0; k < count; ++k) to[k] = from[k];
  };
  copy(d.s0.thermodynamic_forces, d.s1.thermodynamic_forces, components<Dim>);
  copy(d.s0.internal_state_variables, d.s1.internal_state_variables, internal_count<Dim>);
  copy(d.s0.stored_energy, d.s1.stored_energy, 1);
  copy(d.s0.dissipated_energy, d.s1.dissipated_energy, 1);
}

void require(const void* pointer, const char* what) {
  if (pointer == nullptr) throw std::invalid_argument(std::string("invalid_input: no ") + what);
}

void check_pointers(const BehaviourData& d, const Request& r) {
  require(d.s0.gradients, "gradients at the begin");
  require(d.s0.thermodynamic_forces, "thermodynamic forces at the begin");
  require(d.s0.internal_state_variables, "internal state variables at the begin");
  require(d.s1.material_properties, "material properties at the end");
  if (r.speed_of_sound) require(d.speed_of_sound, "place for the speed of sound");
  if (!r.integrate) return;
  require(d.s1.gradients, "gradients at the end");
  require(d.s1.thermodynamic_forces, "thermodynamic forces at the end");
  require(d.s1.internal_state_variables, "internal state variables at the end");
}

/// Of longitudinal waves in the uncracked bulk (in plane stress: in its plane), m/s.
double speed_of_sound(const point::Behaviour& b) {
  return std::sqrt((b.material.bulk.lambda + 2.0 * b.material.bulk.mu) / b.parameters.density);
}

template <int Dim>
Tangent<Dim> other_operator(const point::Behaviour& b, const State<double, Dim>& s, Operator wanted) {
  if (wanted == Operator::secant) return secant_operator<Dim>(b, s);
  if (wanted == Operator::tangent) return tangent_operator<Dim>(b, s);
  return elastic_tangent<Dim>(b.material.bulk);
}

/// What the update left, into s1; `axial_stress` is that of the end.
template <int Dim>
void write_end(const point::Behaviour& b, const State<double, Dim>& end, const point::Outcome& outcome,
               double axial_stress, EndState& s1) {
  write_force<Dim>(b, end.stress, axial_stress, s1.thermodynamic_forces);
  double flat[point::state_size<Dim>];
  point::store<Dim>(end, flat, 1);
  std::copy_n(flat + kept_by_client<Dim>, internal_count<Dim>, s1.internal_state_variables);
  const double along_z = axial_stress == 0.0 ? 0.0 : 0.5 * axial_stress * axial_stress / b.parameters.young_modulus;
  if (s1.stored_energy != nullptr) *s1.stored_energy = outcome.stored_energy + along_z;
  if (s1.dissipated_energy != nullptr) *s1.dissipated_energy = outcome.dissipated_energy;
}

template <int Dim>
int integrate(const point::Behaviour& b, const Request& request, const BeginPoint<Dim>& begin, BehaviourData& d) {
  const Tensor<double, Dim> increment = model_strain<Dim>(b, d.s1.gradients) - model_strain<Dim>(b, d.s0.gradients);
  Tangent<Dim> t;
  State<double, Dim> end;
  const bool consistent = request.wanted == Operator::consistent;
  const point::Outcome outcome = point::update_point<Dim>(b, begin.state, increment, end, consistent ? &t : nullptr);
  if (!outcome.ok()) {
    if (d.rdt != nullptr) *d.rdt = smaller_step;
    return fail(d, point::last_message().c_str());
  }
  double axial_stress = begin.axial_stress;
  if constexpr (Dim == 2) axial_stress += axial_modulus(b) * d.s1.gradients[2];
  write_end<Dim>(b, end, outcome, axial_stress, d.s1);
  if (request.wanted != Operator::none) {
    write_operator<Dim>(b, consistent ? t : other_operator<Dim>(b, end, request.wanted), d.K);
  }
  return done;
}

/// The call proper. Throws where it is refused.
template <int Dim>
int answer(Setting setting, BehaviourData& d, const Request& request) {
  check_pointers(d, request);
  const auto list = full_list(d.s1.material_properties);
  const point::Behaviour& b = point::behaviour_of(setting, list, d.s1.material_properties[length_place]);
  const BeginPoint<Dim> begin = begin_point<Dim>(b, d.s0);
  if (!request.integrate) {
    write_operator<Dim>(b, other_operator<Dim>(b, begin.state, request.wanted), d.K);
  } else if (integrate<Dim>(b, request, begin, d) != done) {
    return failed;
  }
  if (request.speed_of_sound) *d.speed_of_sound = speed_of_sound(b);
  return done;
}

template <int Dim>
int run(Setting setting, BehaviourData& d) noexcept {
  const std::optional<Request> request = d.K != nullptr ? read_request(d.K[0]) : std::nullopt;
  if (!request) return fail(d, "invalid_input: no K, or K[0] is not a number");
  int result = failed;
  try {
    result = answer<Dim>(setting, d, *request);
  } catch (const std::exception& e) {
    fail(d, e.what());
  } catch (...) {
    fail(d, "unknown failure");
  }
  if (result != done && request->integrate) restore<Dim>(d);
  return result;
}

}  // namespace

}  // namespace fpz::generic

#define FPZ_EXPORT extern "C" __attribute__((visibility("default")))

FPZ_EXPORT int Fpz_Tridimensional(fpz::generic::BehaviourData* d) {
  return fpz::generic::run<3>(fpz::Setting::three_d, *d);
}

FPZ_EXPORT int Fpz_PlaneStrain(fpz::generic::BehaviourData* d) {
  return fpz::generic::run<2>(fpz::Setting::plane_strain, *d);
}

FPZ_EXPORT int Fpz_GeneralisedPlaneStrain(fpz::generic::BehaviourData* d) {
  return fpz::generic::run<2>(fpz::Setting::plane_strain, *d);
}

FPZ_EXPORT int Fpz_PlaneStress(fpz::generic::BehaviourData* d) {
  return fpz::generic::run<2>(fpz::Setting::plane_stress, *d);
}

/// 1 when there is such a parameter.
FPZ_EXPORT int Fpz_setParameter(const char* name, double value) {
  return name != nullptr && fpz::generic::set_parameter(name, value) ? 1 : 0;
}

/// All bounds of this behaviour are physical ones and hold whatever the policy.
FPZ_EXPORT void Fpz_setOutOfBoundsPolicy(int) {}
