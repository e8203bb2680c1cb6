#include "fpz/driver/run.hpp"

#include "point_run.hpp"

namespace fpz::driver {

Result run_test(const Test& test, const Observer& observer) {
  return with_dimension(test.setting, [&](auto dim) { return PointRun<decltype(dim)::value>(test, observer).run(); });
}

}  // namespace fpz::driver
