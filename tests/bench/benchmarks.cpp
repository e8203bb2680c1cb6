#include "benchmarks.hpp"

#include <benchmark/benchmark.h>

#include <string>

#include "cases.hpp"
#include "fpz/batch.hpp"
#include "fpz/cohesive_update.hpp"
#include "fpz/onset.hpp"

namespace fpz::bench {
namespace {

using benchmark::State;
template <int Dim>
using Points = std::vector<fpz::State<double, Dim>>;

/// Runs `step(i)` for i = 0, 1, ... cyclically over the points; it returns the report of one update.
template <class Step>
void run(State& state, const Step& step) {
  int i = 0;
  long iterations = 0;
  long updates = 0;
  for (auto _ : state) {
    const Report r = step(i);
    if (!r.ok()) {
      state.SkipWithError(to_string(r.status));
      break;
    }
    iterations += r.iterations;
    ++updates;
    i = (i + 1) % point_count;
  }
  state.counters["iterations"] = updates > 0 ? static_cast<double>(iterations) / static_cast<double>(updates) : 0.0;
}

template <int Dim>
void update_points(State& state, const Points<Dim>& points, const Options& o, const Tensor<double, Dim>& d) {
  const Material<double> m = johnstone<Dim>();
  fpz::State<double, Dim> end;
  run(state, [&](int i) {
    const Report r = update<Dim>(m, o, points[static_cast<std::size_t>(i)], d, end);
    benchmark::DoNotOptimize(end);
    return r;
  });
}

template <int Dim>
void intact(State& state, double level) {
  Tensor<double, Dim> d = Tensor<double, Dim>::Constant(1e-8);
  update_points<Dim>(state, intact_points<Dim>(johnstone<Dim>(), level), options_of(Method::implicit), d);
}

/// The paper's scan runs in every update of an intact point.
template <int Dim>
void intact_scan(State& state, double degrees) {
  Options o = options_of(Method::paper);
  o.scan_resolution_deg = degrees;
  update_points<Dim>(state, intact_points<Dim>(johnstone<Dim>(), 0.995), o, Tensor<double, Dim>::Constant(1e-8));
}

template <int Dim>
void plane_search(State& state, double degrees) {
  const Material<double> m = johnstone<Dim>();
  const Points<Dim> points = intact_points<Dim>(m, 0.995);
  run(state, [&](int i) {
    const Tensor<double, Dim>& stress = points[static_cast<std::size_t>(i)].stress;
    auto plane = degrees > 0.0 ? scan_planes<Dim>(m, stress, degrees) : critical_plane<Dim>(m, stress);
    benchmark::DoNotOptimize(plane);
    return Report{};
  });
}

/// Cracked points under `factor` times the paper's increment; a negative factor unloads.
template <int Dim>
void cracked(State& state, Method method, double tolerance, double factor) {
  update_points<Dim>(state, yielding_points<Dim>(johnstone<Dim>()), options_of(method, tolerance),
                     mixed_loading<Dim>(factor * paper_increment));
}

template <int Dim>
void cracked_tangent(State& state, Method method, double tolerance, double factor) {
  const Material<double> m = johnstone<Dim>();
  const Points<Dim> points = yielding_points<Dim>(m);
  const Options o = options_of(method, tolerance);
  const Tensor<double, Dim> d = mixed_loading<Dim>(factor * paper_increment);
  fpz::State<double, Dim> end;
  Tangent<Dim> tangent;
  run(state, [&](int i) {
    const Report r = update_with_tangent<Dim>(m, o, points[static_cast<std::size_t>(i)], d, end, tangent);
    benchmark::DoNotOptimize(tangent);
    return r;
  });
}

/// Stage 2 of the four-stage path at the paper's increments, one update after the other on one state.
void stage_2(State& state) {
  constexpr int updates = 2000;
  const Material<double> m = johnstone<2>();
  const Tensor<double, 2> d = mixed_loading<2>(paper_increment);
  fpz::State<double, 2> begin, s;
  const Tensor<double, 2> stage_1 = test::strain2(12000 * paper_increment, 0, 0);
  if (!update<2>(m, options_of(Method::accurate, 1e-10), begin, stage_1, begin).ok()) {
    state.SkipWithError("stage 1");
    return;
  }
  const Options o = options_of(Method::implicit);
  int done = updates;
  run(state, [&](int) {
    if (++done > updates) {
      s = begin;
      done = 1;
    }
    const Report r = update<2>(m, o, s, d, s);
    benchmark::DoNotOptimize(s);
    return r;
  });
}

/// Algorithm 1 alone: the jump that the same strain increment brings is imposed.
void algorithm1(State& state, Method method, double tolerance, double factor) {
  const Material<double> m = johnstone<2>();
  const Points<2> points = yielding_points<2>(m);
  const Options o = options_of(method, tolerance);
  const Vec<double, 2> du(factor * paper_increment * m.rve_length, factor * 10.0 * paper_increment * m.rve_length);
  CohesiveState<double, 2> end;
  run(state, [&](int i) {
    const Report r = cohesive_update(m.law, o, points[static_cast<std::size_t>(i)].crack, du, end);
    benchmark::DoNotOptimize(end);
    return r;
  });
}

/// 1e5 points in one call; `cracked_share` of them yield.
void batch(State& state, int threads, double cracked_share) {
  constexpr std::size_t count = 100000;
  const Material<double> m = johnstone<2>();
  const Points<2> intact = intact_points<2>(m, 0.5);
  const Points<2> yielding = yielding_points<2>(m);
  Points<2> begin(count), end(count);
  const auto limit = static_cast<std::size_t>(cracked_share * 100.0);
  for (std::size_t i = 0; i < count; ++i) {
    begin[i] = (i / 64) % 100 < limit ? yielding[i % point_count] : intact[i % point_count];
  }
  const std::vector<Tensor<double, 2>> d(count, mixed_loading<2>(paper_increment));
  const Options o = options_of(Method::implicit);
  for (auto _ : state) {
    const BatchReport r = update_batch<2>(m, o, begin, d, end, {}, threads);
    if (!r.ok()) {
      state.SkipWithError(to_string(r.first_status));
      break;
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(count));
}

template <class F>
benchmark::internal::Benchmark* add(const std::string& name, const F& f) {
  return benchmark::RegisterBenchmark(name.c_str(), f);
}

template <int Dim>
void add_dimension() {
  const std::string dim = Dim == 2 ? "2d" : "3d";
  add("elastic/" + dim, [](State& s) { intact<Dim>(s, 0.5); });
  add("elastic near surface/" + dim, [](State& s) { intact<Dim>(s, 0.999); });
  add("onset closed form/" + dim, [](State& s) { plane_search<Dim>(s, 0.0); });
  add("onset scan/" + dim + "/1 deg", [](State& s) { plane_search<Dim>(s, 1.0); });
  add("onset scan/" + dim + "/5 deg", [](State& s) { plane_search<Dim>(s, 5.0); });
  add("elastic with scan/" + dim + "/5 deg", [](State& s) { intact_scan<Dim>(s, 5.0); });
  add("unloading/" + dim + "/implicit", [](State& s) { cracked<Dim>(s, Method::implicit, 1e-4, -1.0); });
  add("unloading/" + dim + "/accurate", [](State& s) { cracked<Dim>(s, Method::accurate, 1e-6, -1.0); });
  for (const double factor : {1.0, 30.0, 300.0}) {
    const std::string times = std::to_string(static_cast<int>(factor)) + "x";
    add("yielding/" + dim + "/implicit/" + times, [=](State& s) { cracked<Dim>(s, Method::implicit, 1e-4, factor); });
    for (const int digits : {4, 6, 8}) {
      const std::string setting = "accurate 1e-" + std::to_string(digits) + "/" + times;
      const double tolerance = std::pow(10.0, -digits);
      add("yielding/" + dim + "/" + setting, [=](State& s) { cracked<Dim>(s, Method::accurate, tolerance, factor); });
    }
  }
  add("yielding/" + dim + "/paper/0.5x", [](State& s) { cracked<Dim>(s, Method::paper, 1e-4, 0.5); });
  add("tangent/" + dim + "/implicit/1x", [](State& s) { cracked_tangent<Dim>(s, Method::implicit, 1e-4, 1.0); });
  add("tangent/" + dim + "/accurate 1e-6/1x", [](State& s) { cracked_tangent<Dim>(s, Method::accurate, 1e-6, 1.0); });
  add("tangent/" + dim + "/paper/0.5x", [](State& s) { cracked_tangent<Dim>(s, Method::paper, 1e-4, 0.5); });
}

}  // namespace

void register_benchmarks() {
  add_dimension<2>();
  add_dimension<3>();
  add("onset scan/2d/0.1 deg", [](State& s) { plane_search<2>(s, 0.1); });
  add("yielding/2d/implicit/stage 2", stage_2);
  add("algorithm 1/2d/implicit/1x", [](State& s) { algorithm1(s, Method::implicit, 1e-4, 1.0); });
  add("algorithm 1/2d/accurate 1e-6/1x", [](State& s) { algorithm1(s, Method::accurate, 1e-6, 1.0); });
  add("algorithm 1/2d/paper/0.5x", [](State& s) { algorithm1(s, Method::paper, 1e-4, 0.5); });
  for (const int threads : {1, 2}) {
    const std::string on = std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    add("batch of 1e5/2d/elastic/" + on, [=](State& s) { batch(s, threads, 0.0); })->UseRealTime();
    add("batch of 1e5/2d/10 % yielding/" + on, [=](State& s) { batch(s, threads, 0.1); })->UseRealTime();
  }
}

}  // namespace fpz::bench
