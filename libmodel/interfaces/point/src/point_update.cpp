#include "fpz/point/point_update.hpp"

#include <algorithm>
#include <exception>
#include <sstream>
#include <utility>

#include "fpz/energy.hpp"
#include "fpz/update.hpp"

namespace fpz::point {

namespace {

std::string& message_of_thread() {
  thread_local std::string message;
  return message;
}

/// What the status means for who called, and what helps.
std::string explanation(const Behaviour& b, Status status) {
  std::ostringstream text;
  text.precision(6);
  text << to_string(status) << ": ";
  switch (status) {
    case Status::ok:
      break;
    case Status::non_convergence:
      text << "the integrator \"" << to_string(b.options.method)
           << "\" does not converge: take a smaller increment, or \"accurate\"";
      break;
    case Status::snap_back:
      text << "the fracture softens faster than the bulk of the length H unloads, and the response is not unique. "
              "rve_length = "
           << b.parameters.rve_length << " here; in mode I it must be < " << b.snap_back_length
           << ", in mixed mode lower: take smaller elements or a smaller rve_length";
      break;
    case Status::no_plastic_flow:
      text
          << "the flow rule has no opening (dilation_angle_deg = 0) that could relax the tension: use an angle above 0";
      break;
    case Status::invalid_input:
      text << "a strain, an increment or a number of the state is not finite";
      break;
  }
  return text.str();
}

template <int Dim>
void explain(const Behaviour& b, const State<double, Dim>& begin, const Tensor<double, Dim>& increment, Status status) {
  std::string message = explanation(b, status);
  const std::string captured = capture_failure<Dim>(b, begin, increment, status);
  if (!captured.empty()) message += "; " + captured;
  set_last_message(std::move(message));
}

}  // namespace

const std::string& last_message() noexcept { return message_of_thread(); }

void set_last_message(std::string message) noexcept { message_of_thread() = std::move(message); }

template <int Dim>
Outcome update_point(const Behaviour& b, const State<double, Dim>& begin, const Tensor<double, Dim>& increment,
                     State<double, Dim>& end, Tangent<Dim>* tangent) noexcept {
  Outcome out;
  try {
    State<double, Dim> result;
    const Report report = tangent != nullptr
                              ? update_with_tangent<Dim>(b.material, b.options, begin, increment, result, *tangent)
                              : update<Dim>(b.material, b.options, begin, increment, result);
    out = {report.status, report.iterations, report.substeps, report.onset, 0.0, 0.0};
    if (!report.ok()) explain<Dim>(b, begin, increment, report.status);
    end = result;
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
