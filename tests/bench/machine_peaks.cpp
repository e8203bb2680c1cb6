#include "machine_peaks.hpp"

#include <algorithm>
#include <vector>

#include "stopwatch.hpp"

namespace fpz::bench {

namespace {

volatile double sink = 0.0;

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));

/// Chains of independent numbers, so that neither latency nor memory counts.
template <class Register>
__attribute__((always_inline)) inline double chains(long rounds) {
  Register a = Register{} + 1.0, b = a, c = a, d = a, e = a, f = a, g = a, h = a;
  const Register m = Register{} + 0.999999, p = Register{} + 1e-6;
  for (long k = 0; k < rounds; ++k) {
    a = a * m, b = b + p, c = c * m, d = d + p, e = e * m, f = f + p, g = g * m, h = h + p;
  }
  const Register sum = ((a + b) + (c + d)) + ((e + f) + (g + h));
  return sum[0];
}

double narrow(long rounds) { return chains<Two>(rounds); }
#if defined(__x86_64__)
__attribute__((target("avx2"))) double wide(long rounds) { return chains<Four>(rounds); }
__attribute__((target("avx512f,avx512vl"))) double widest(long rounds) { return chains<Eight>(rounds); }
#endif

double rate(double (*loop)(long), int width) {
  constexpr long rounds = 20'000'000;
  double best = 0.0;
  for (int r = 0; r < 5; ++r) {
    const double begin = seconds();
    sink = loop(rounds);
    best = std::max(best, 8.0 * width * rounds / (seconds() - begin));
  }
  return best;
}

}  // namespace

double arithmetic() {
  double best = rate(narrow, 2);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) best = std::max(best, rate(wide, 4));
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) best = std::max(best, rate(widest, 8));
#endif
  return best;
}

double bandwidth(std::size_t bytes) {
  const std::size_t size = bytes / (3 * sizeof(double));
  std::vector<double> a(size, 0.0), b(size, 1.0), c(size, 2.0);
  double best = 0.0;
  const int passes = static_cast<int>(std::max<std::size_t>(1, 400'000'000 / bytes));
  for (int r = 0; r < 5; ++r) {
    const double begin = seconds();
    for (int k = 0; k < passes; ++k) {
      const double s = 1e-9 * k;
      for (std::size_t i = 0; i < size; ++i) a[i] = b[i] + s * c[i];
      sink = a[size / 2];
    }
    best = std::max(best, 3.0 * sizeof(double) * static_cast<double>(size) * passes / (seconds() - begin));
  }
  return best;
}

}  // namespace fpz::bench
