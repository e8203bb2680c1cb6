#include "explain.hpp"

#include <sstream>
#include <string>
#include <utility>

#include "fpz/point/failure_capture.hpp"
#include "fpz/point/point_update.hpp"

namespace fpz::point {

namespace {

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

}  // namespace

template <int Dim>
void explain(const Behaviour& b, const State<double, Dim>& begin, const Tensor<double, Dim>& increment, Status status) {
  std::string message = explanation(b, status);
  const std::string captured = capture_failure<Dim>(b, begin, increment, status);
  if (!captured.empty()) message += "; " + captured;
  set_last_message(std::move(message));
}

template void explain<2>(const Behaviour&, const State<double, 2>&, const Tensor<double, 2>&, Status);
template void explain<3>(const Behaviour&, const State<double, 3>&, const Tensor<double, 3>&, Status);

}  // namespace fpz::point
