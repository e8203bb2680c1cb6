#include "fpz/point/point_update.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "explain.hpp"
#include "fpz/energy.hpp"
#include "fpz/update.hpp"

namespace fpz::point {

namespace {

std::string& message_of_thread() {
  thread_local std::string message;
  return message;
}

}  // namespace

const std::string& last_message() noexcept { return message_of_thread(); }

void set_last_message(std::string message) noexcept { message_of_thread() = std::move(message); }

template <int Dim>
Outcome update_point(const Behaviour& b, const State<double, Dim>& begin, const Tensor<double, Dim>& increment,
                     State<double, Dim>& end, Tangent<Dim>* tangent) noexcept {
  Outcome out;
  try {
    const Report report = tangent != nullptr
                              ? update_with_tangent<Dim>(b.material, b.options, begin, increment, end, *tangent)
                              : update<Dim>(b.material, b.options, begin, increment, end);
    out = {report.status, report.iterations, report.substeps, report.onset, 0.0, 0.0};
    if (!report.ok()) explain<Dim>(b, begin, increment, report.status);
    out.stored_energy = stored_energy(b.material, end);
    out.dissipated_energy = dissipated_energy(b.material, end);
  } catch (const std::exception& e) {
    out.status = Status::non_convergence;
    set_last_message(e.what());
    end = begin;
  }
  return out;
}

template <int Dim>
Outcome update_flat(const Behaviour& b, const double* begin, const double* strain_increment, double* end,
                    double* tangent) noexcept {
  State<double, Dim> state;
  if (!load<Dim>(begin, 1, state)) {
    set_last_message(std::string("invalid_input: ") + not_a_state);
    if (end != begin) std::copy(begin, begin + state_size<Dim>, end);
    return {Status::invalid_input};
  }
  Tensor<double, Dim> increment;
  for (int k = 0; k < tensor_size<Dim>; ++k) increment[k] = strain_increment[k];
  Tangent<Dim> derivative;
  const Outcome out = update_point<Dim>(b, state, increment, state, tangent != nullptr ? &derivative : nullptr);
  store<Dim>(state, end, 1);
  if (tangent != nullptr && out.ok()) {
    for (int i = 0; i < tensor_size<Dim>; ++i) {
      for (int j = 0; j < tensor_size<Dim>; ++j) *tangent++ = derivative(i, j);
    }
  }
  return out;
}

template Outcome update_point<2>(const Behaviour&, const State<double, 2>&, const Tensor<double, 2>&, State<double, 2>&,
                                 Tangent<2>*) noexcept;
template Outcome update_point<3>(const Behaviour&, const State<double, 3>&, const Tensor<double, 3>&, State<double, 3>&,
                                 Tangent<3>*) noexcept;
template Outcome update_flat<2>(const Behaviour&, const double*, const double*, double*, double*) noexcept;
template Outcome update_flat<3>(const Behaviour&, const double*, const double*, double*, double*) noexcept;

}  // namespace fpz::point
