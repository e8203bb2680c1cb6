// What a failed update says.
#pragma once

#include "fpz/point/behaviour.hpp"
#include "fpz/state.hpp"

namespace fpz::point {

/// Sets last_message() to the cause of a failure and the way out, and captures the update.
template <int Dim>
void explain(const Behaviour& behaviour, const State<double, Dim>& begin, const Tensor<double, Dim>& increment,
             Status status);

}  // namespace fpz::point
