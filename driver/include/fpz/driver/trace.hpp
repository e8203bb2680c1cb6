// A run with every step it was made of, so that it can be repeated with derivatives or entered between its rows.
#pragma once

#include <vector>

#include "fpz/driver/run.hpp"
#include "fpz/state.hpp"

namespace fpz::driver {

/// One accepted step: an increment of the stage, or the part of it that halving left.
template <int Dim>
struct TracedStep {
  int stage = 0;    ///< counts from 0
  double s0 = 0.0;  ///< fractions of the stage
  double s1 = 0.0;
  State<double, Dim> begin;
  State<double, Dim> end;
};

template <int Dim>
struct Trace {
  Result result;
  std::vector<TracedStep<Dim>> steps;  ///< without gaps, up to the last row
};

/// Runs a test as run_test() does. Dim must fit the setting.
template <int Dim>
[[nodiscard]] Trace<Dim> trace_test(const Test& test);

extern template Trace<2> trace_test<2>(const Test&);
extern template Trace<3> trace_test<3>(const Test&);

}  // namespace fpz::driver
