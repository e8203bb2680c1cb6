#include "fpz/driver/run.hpp"

#include "point_run.hpp"

namespace fpz::driver {

template <int Dim>
Trace<Dim> trace_test(const Test& test) {
  Trace<Dim> trace;
  trace.result = PointRun<Dim>(test, {}, {}, &trace.steps).run();
  return trace;
}

template Trace<2> trace_test<2>(const Test&);
template Trace<3> trace_test<3>(const Test&);

Result run_test(const Test& test, const Observer& observer) {
  return with_dimension(test.setting, [&](auto dim) { return PointRun<decltype(dim)::value>(test, observer).run(); });
}

}  // namespace fpz::driver
