// Takes one material point through the stages of a test and records its history.
#pragma once

#include <functional>
#include <vector>

#include "fpz/driver/run.hpp"
#include "fpz/driver/trace.hpp"

namespace fpz::driver {

/// Called after every accepted step under strain or mixed control: begin state, strain increment, time.
template <int Dim>
using StepHook = std::function<void(const State<double, Dim>& begin, const Tensor<double, Dim>& dstrain, double time)>;

/// run_test() for one dimension. `trace`, when given, receives the steps that lead from row to row. Dim 2 and 3.
template <int Dim>
[[nodiscard]] Result run_point(const Test& test, const Observer& observer, const StepHook<Dim>& hook = {},
                               std::vector<TracedStep<Dim>>* trace = nullptr);

}  // namespace fpz::driver
