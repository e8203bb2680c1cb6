// What a client wants from a call: the number K[0].
#pragma once

#include <cmath>
#include <optional>

namespace fpz::generic {

enum class Operator { none, elastic, secant, tangent, consistent };

struct Request {
  bool integrate = true;  ///< false: only the operator at the begin of the step (a prediction)
  bool speed_of_sound = false;
  Operator wanted = Operator::none;
};

/// K[0] above 50 asks for the speed of sound too and is 100 too large. Below -0.5 a prediction, otherwise an
/// integration; the size says with which operator: 0 none, 1 elastic, 2 secant, 3 tangent, 4 consistent. Nothing when
/// it is no number.
[[nodiscard]] inline std::optional<Request> read_request(double k0) {
  if (!std::isfinite(k0)) return std::nullopt;
  Request r;
  r.speed_of_sound = k0 > 50.0;
  const double k = r.speed_of_sound ? k0 - 100.0 : k0;
  r.integrate = k >= -0.5;
  const double size = std::abs(k);
  if (size > 3.5 && r.integrate) {
    r.wanted = Operator::consistent;
  } else if (size > 2.5) {
    r.wanted = Operator::tangent;
  } else if (size > 1.5) {
    r.wanted = Operator::secant;
  } else if (size > 0.5) {
    r.wanted = Operator::elastic;
  }
  return r;
}

}  // namespace fpz::generic
