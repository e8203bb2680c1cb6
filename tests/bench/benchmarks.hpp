// The timed updates, registered by name. fpz-bench runs them all; fpz-speed-report runs them with its own reporter.
#pragma once

namespace fpz::bench {

/// Registers every benchmark with Google Benchmark. Names: "<what>/<2d|3d>/<integrator and setting>".
void register_benchmarks();

}  // namespace fpz::bench
