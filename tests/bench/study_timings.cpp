#include <benchmark/benchmark.h>

#include <algorithm>

#include "benchmarks.hpp"
#include "studies.hpp"

namespace fpz::bench {
namespace {

/// Keeps the fastest repetition of every benchmark.
class Fastest : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      Timing t{run.run_name.function_name, 0.0, 0.0, run.family_index};
      const auto items = run.counters.find("items_per_second");
      // A batch is timed by the wall clock, because CPU time adds the threads up.
      t.nanoseconds = items != run.counters.end()
                          ? 1e9 / items->second.value
                          : run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit) * 1e9;
      if (const auto n = run.counters.find("iterations"); n != run.counters.end()) t.iterations = n->second.value;
      const auto known =
          std::find_if(timings.begin(), timings.end(), [&](const Timing& o) { return o.name == t.name; });
      if (known == timings.end()) {
        timings.push_back(t);
      } else if (t.nanoseconds < known->nanoseconds) {
        *known = t;
      }
    }
  }

  std::vector<Timing> timings;
};

}  // namespace

std::vector<Timing> study_timings() {
  std::vector<std::string> arguments = {"fpz-speed-report", "--benchmark_repetitions=30", "--benchmark_min_time=0.01",
                                        "--benchmark_enable_random_interleaving=true"};
  std::vector<char*> argv;
  for (std::string& a : arguments) argv.push_back(a.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  register_benchmarks();
  Fastest reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  std::sort(reporter.timings.begin(), reporter.timings.end(),
            [](const Timing& a, const Timing& b) { return a.order < b.order; });
  return reporter.timings;
}

}  // namespace fpz::bench
