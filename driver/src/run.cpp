#include "fpz/driver/run.hpp"

#include "fpz/driver/dimension.hpp"
#include "point_run.hpp"

namespace fpz::driver {

template <int Dim>
Trace<Dim> trace_test(const Test& test) {
  Trace<Dim> trace;
  trace.result = run_point<Dim>(test, {}, {}, &trace.steps);
  return trace;
}

template Trace<2> trace_test<2>(const Test&);
template Trace<3> trace_test<3>(const Test&);

Result run_test(const Test& test, const Observer& observer) {
  return with_dimension(test.setting, [&](auto dim) { return run_point<decltype(dim)::value>(test, observer); });
}

}  // namespace fpz::driver
