// fpz-interface-bench: what a call through each interface costs more than the C++ call that does the same.
//   fpz-interface-bench [--quick] [--write PAGE.md]
// Both calls of a row take turns, a few milliseconds each; every turn gives one difference, and the table has their
// median. --write puts the table between the marks <!-- measured: interfaces --> and <!-- end of measured --> of a
// page.
// --quick only sees that everything runs.
#include <fpz.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases.hpp"
#include "fpz/batch.hpp"
#include "fpz/energy.hpp"
#include "fpz/point/properties.hpp"
#include "fpz/point/state_layout.hpp"
#include "fpz/tangent.hpp"
#include "interfaces/umat/umat_call.hpp"
#include "walk.hpp"
#ifdef FPZ_BENCH_GENERIC
#include "behaviour_data.hpp"
#include "lists.hpp"
extern "C" int Fpz_PlaneStrain(fpz::generic::BehaviourData*);
#endif

#ifdef FPZ_BENCH_PYTHON
#include "python_jobs.hpp"
#endif

namespace {

using namespace fpz;
using bench::point_count;

/// A call per point of a ring, `calls` of them.
using Job = std::function<void(int calls)>;

struct Row {
  std::string what;
  int points;  ///< of one call of the jobs
  Job direct;
  Job through;
};

struct Times {
  double direct = 0.0;   ///< medians, seconds a point
  double through = 0.0;  ///< direct + the median of the differences
};

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

double seconds_of(const Job& job, int calls) {
  const double begin = bench::cpu_seconds();
  job(calls);
  return bench::cpu_seconds() - begin;
}

Times measure(const Row& row, bool quick) {
  int calls = 16;
  const double turn = quick ? 1e-5 : 3e-3;
  while (seconds_of(row.direct, calls) < turn) calls *= 2;
  const int turns = quick ? 3 : 201;
  std::vector<double> direct, difference;
  for (int k = 0; k < turns; ++k) {
    // In every second turn the other one is first.
    double a = k % 2 == 0 ? seconds_of(row.direct, calls) : 0.0;
    const double b = seconds_of(row.through, calls);
    if (k % 2 != 0) a = seconds_of(row.direct, calls);
    direct.push_back(a / calls / row.points);
    difference.push_back((b - a) / calls / row.points);
  }
  const double middle = median(direct);
  return {middle, middle + median(difference)};
}

void check(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(std::string(what) + ": the update failed");
}

/// A point's begin states, and the increment that is applied to each.
struct Ring {
  std::string name;
  std::vector<State2> begin;
  Tensor<double, 2> increment;
};

struct Setup {
  Parameters parameters = test::with_zone(test::table1(), CohesiveZone::consistent);
  std::vector<double> list = point::write_properties({parameters, {}});
  Material<double> material = make_material(parameters, Setting::plane_strain);
  Options options;
  fpz_material* handle = nullptr;

  Setup() { check(fpz_material_new(FPZ_PLANE_STRAIN, list.data(), int(list.size()), &handle) == FPZ_OK, "material"); }
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;
  ~Setup() { fpz_material_free(handle); }
};

using Flat = std::vector<double>;
constexpr std::size_t row_size = point::state_size<2>;

Flat flat(const std::vector<State2>& states) {
  Flat numbers(states.size() * row_size);
  for (std::size_t k = 0; k < states.size(); ++k) point::store<2>(states[k], &numbers[k * row_size], 1);
  return numbers;
}

Job direct_update(const Setup& s, const Ring& ring) {
  return [&s, &ring](int calls) {
    State2 end;
    for (int k = 0; k < calls; ++k) {
      const Report r = update<2>(s.material, s.options, ring.begin[std::size_t(k % point_count)], ring.increment, end);
      check(r.ok(), "C++");
    }
  };
}

/// With tangent and energies, as a finite-element program wants them.
Job direct_full(const Setup& s, const Ring& ring) {
  return [&s, &ring](int calls) {
    State2 end;
    Tangent<2> tangent;
    double energy = 0.0;
    for (int k = 0; k < calls; ++k) {
      const auto i = std::size_t(k % point_count);
      check(update_with_tangent<2>(s.material, s.options, ring.begin[i], ring.increment, end, tangent).ok(), "C++");
      energy += stored_energy(s.material, end) + dissipated_energy(s.material, end);
    }
    check(energy > 0.0, "C++");
  };
}

Job c_update(const Setup& s, const Ring& ring, bool full) {
  return [&s, &ring, full, begin = flat(ring.begin)](int calls) {
    double end[row_size], tangent[9], energies[2];
    for (int k = 0; k < calls; ++k) {
      const double* from = &begin[std::size_t(k % point_count) * row_size];
      const fpz_status status =
          fpz_update(s.handle, from, ring.increment.data(), end, full ? tangent : nullptr, full ? energies : nullptr);
      check(status == FPZ_OK, "C");
    }
  };
}

Job umat_update(const Setup& s, const Ring& ring) {
  test::Umat umat(3, 1, s.list);
  std::vector<test::Umat> points(point_count, umat);
  for (std::size_t k = 0; k < points.size(); ++k) {
    point::store<2>(ring.begin[k], points[k].statev.data(), 1);
    points[k].stress = {ring.begin[k].stress[0], ring.begin[k].stress[1], 0.0, ring.begin[k].stress[2]};
  }
  const std::array<double, 6> dstran = {ring.increment[0], ring.increment[1], 0.0, 2.0 * ring.increment[2]};
  return [points, dstran](int calls) {
    test::Umat work = points[0];
    const int nprops = int(work.props.size());
    double no[9] = {};
    for (int k = 0; k < calls; ++k) {
      const test::Umat& from = points[std::size_t(k % point_count)];
      // A program copies the state before every iteration, too: it is in place.
      std::copy_n(from.statev.data(), row_size, work.statev.data());
      work.stress = from.stress;
      umat_(work.stress.data(), work.statev.data(), work.ddsdde.data(), &work.sse, &work.spd, no, no, no, no, no, no,
            dstran.data(), no, no, no, no, no, no, nullptr, &work.ndi, &work.nshr, &work.ntens, &work.nstatv,
            work.props.data(), &nprops, no, work.drot.data(), &work.pnewdt, &work.celent, no, no, &work.noel, &work.npt,
            nullptr, nullptr, nullptr, nullptr, 80);
    }
    check(!work.failed(), "UMAT");
  };
}

#ifdef FPZ_BENCH_GENERIC
Job generic_update(const Setup& s, const Ring& ring) {
  constexpr std::size_t kept = generic::kept_by_client<2>;
  return [&s, &ring, begin = flat(ring.begin)](int calls) {
    const double root = std::sqrt(2.0);
    double k_matrix[16], force[4] = {}, internal[generic::internal_count<2>], stored = 0.0, dissipated = 0.0, rdt = 1.0;
    for (int k = 0; k < calls; ++k) {
      const double* from = &begin[std::size_t(k % point_count) * row_size];
      const double e0[4] = {from[0], from[1], 0.0, root * from[2]};
      const double s0[4] = {from[3], from[4], s.parameters.poisson_ratio * (from[3] + from[4]), root * from[5]};
      const double e1[4] = {e0[0] + ring.increment[0], e0[1] + ring.increment[1], 0.0,
                            e0[3] + root * ring.increment[2]};
      k_matrix[0] = 4.0;
      generic::BehaviourData d{nullptr,
                               1.0,
                               k_matrix,
                               &rdt,
                               nullptr,
                               {e0, s0, nullptr, s.list.data(), from + kept, &stored, &dissipated, nullptr},
                               {e1, force, nullptr, s.list.data(), internal, &stored, &dissipated, nullptr}};
      check(Fpz_PlaneStrain(&d) == 1, "generic");
    }
  };
}
#endif

constexpr std::size_t batch_points = 2000;

template <class T>
std::vector<T> repeated(const std::vector<T>& ring) {
  std::vector<T> all;
  for (std::size_t k = 0; k < batch_points; ++k) all.push_back(ring[k % ring.size()]);
  return all;
}

Job direct_batch(const Setup& s, const Ring& ring, bool tangents) {
  return [&s, begin = repeated(ring.begin), end = repeated(ring.begin),
          increments = std::vector<Tensor<double, 2>>(batch_points, ring.increment),
          stiffness = std::vector<Tangent<2>>(tangents ? batch_points : 0)](int calls) mutable {
    for (int k = 0; k < calls; ++k) {
      check(update_batch<2>(s.material, s.options, begin, increments, end, stiffness, 1).ok(), "C++ batch");
    }
  };
}

Job c_batch(const Setup& s, const Ring& ring, bool tangents, bool by_point) {
  Flat begin = flat(repeated(ring.begin)), increments(3 * batch_points);
  const std::ptrdiff_t point = by_point ? std::ptrdiff_t(row_size) : 1;
  const std::ptrdiff_t component = by_point ? 1 : std::ptrdiff_t(batch_points);
  for (std::size_t k = 0; k < batch_points; ++k) {
    for (std::size_t i = 0; i < 3; ++i) increments[3 * k + i] = ring.increment[int(i)];
    if (!by_point) point::store<2>(ring.begin[k % ring.begin.size()], &begin[k], component);
  }
  return [&s, begin, end = begin, increments, point, component,
          stiffness = Flat(tangents ? 9 * batch_points : 0)](int calls) mutable {
    fpz_batch b{};
    b.points = batch_points;
    b.begin = {begin.data(), point, component};
    b.end = {end.data(), point, component};
    b.strain_increments = {increments.data(), 3, 1};
    if (!stiffness.empty()) b.tangents = {stiffness.data(), 9, 1};
    b.threads = 1;
    for (int k = 0; k < calls; ++k) check(fpz_update_batch(s.handle, &b, nullptr) == FPZ_OK, "C batch");
  };
}

/// In place, there and back, so that the points stay where they are.
Job direct_batch_in_place(const Setup& s, const Ring& ring) {
  using Increments = std::vector<Tensor<double, 2>>;
  return [&s, states = repeated(ring.begin), there = Increments(batch_points, ring.increment),
          back = Increments(batch_points, Tensor<double, 2>(-ring.increment))](int calls) mutable {
    for (int k = 0; k < calls; ++k) {
      check(update_batch<2>(s.material, s.options, states, k % 2 == 0 ? there : back, states, {}, 1).ok(), "C++ batch");
    }
  };
}

Job c_batch_in_place(const Setup& s, const Ring& ring) {
  Flat there(3 * batch_points);
  for (std::size_t k = 0; k < there.size(); ++k) there[k] = ring.increment[int(k % 3)];
  Flat back = there;
  for (double& x : back) x = -x;
  return [&s, states = flat(repeated(ring.begin)), there, back](int calls) mutable {
    fpz_batch b{};
    b.points = batch_points;
    b.begin = b.end = {states.data(), std::ptrdiff_t(row_size), 1};
    b.threads = 1;
    for (int k = 0; k < calls; ++k) {
      b.strain_increments = {k % 2 == 0 ? there.data() : back.data(), 3, 1};
      check(fpz_update_batch(s.handle, &b, nullptr) == FPZ_OK, "C batch");
    }
  };
}

#ifdef FPZ_BENCH_PYTHON
/// A point there and back.
Job direct_walk(const Setup& s, const Ring& ring) {
  return [&s, &ring](int calls) {
    State2 state = ring.begin[0];
    const Tensor<double, 2> back = -ring.increment;
    for (int k = 0; k < calls; ++k) {
      check(update<2>(s.material, s.options, state, k % 2 == 0 ? ring.increment : back, state).ok(), "C++");
    }
  };
}

void add_python_rows(std::vector<Row>& rows, const Setup& s, const Ring& ring) {
  const bench::PythonModule module(FPZ_BENCH_PYTHON, s.parameters);
  const std::string at = ", " + ring.name;
  const int n = int(batch_points);
  const std::vector<State2> states = repeated(ring.begin);
  const auto batch = [&](bool tangents) { return module.batch(states, ring.increment, tangents); };
  rows.push_back({"Python, Point.update()" + at, 1, direct_walk(s, ring), module.walk(ring.begin[0], ring.increment)});
  rows.push_back({"Python batch" + at, n, direct_batch(s, ring, false), batch(false)});
  rows.push_back({"Python batch with tangents" + at, n, direct_batch(s, ring, true), batch(true)});
}
#endif

std::vector<Row> rows_for(const Setup& s, const Ring& ring) {
  const std::string at = ", " + ring.name;
  const int n = int(batch_points);
  std::vector<Row> rows;
  rows.push_back({"C" + at, 1, direct_update(s, ring), c_update(s, ring, false)});
  rows.push_back({"C with tangent and energies" + at, 1, direct_full(s, ring), c_update(s, ring, true)});
  rows.push_back({"UMAT" + at, 1, direct_full(s, ring), umat_update(s, ring)});
#ifdef FPZ_BENCH_GENERIC
  rows.push_back({"generic behaviour" + at, 1, direct_full(s, ring), generic_update(s, ring)});
#endif
  rows.push_back({"C batch, by points" + at, n, direct_batch(s, ring, false), c_batch(s, ring, false, true)});
  rows.push_back({"C batch, by components" + at, n, direct_batch(s, ring, false), c_batch(s, ring, false, false)});
  if (!ring.begin[0].cracked) {
    rows.push_back({"C batch, in place" + at, n, direct_batch_in_place(s, ring), c_batch_in_place(s, ring)});
  }
  rows.push_back({"C batch with tangents" + at, n, direct_batch(s, ring, true), c_batch(s, ring, true, true)});
#ifdef FPZ_BENCH_PYTHON
  add_python_rows(rows, s, ring);
#endif
  return rows;
}

std::string print(const char* format, double x) {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

std::string table(const Setup& s, const std::vector<Ring>& rings, bool quick) {
  std::string text = "| call | C++, ns a point | overhead, ns | overhead, % |\n| --- | --- | --- | --- |\n";
  for (const Ring& ring : rings) {
    for (const Row& row : rows_for(s, ring)) {
      const Times t = measure(row, quick);
      text += "| " + row.what + " | " + print("%.0f", 1e9 * t.direct) + " | " +
              print("%.0f", std::round(1e9 * (t.through - t.direct)) + 0.0) + " | " +
              print("%.1f", 100.0 * (t.through / t.direct - 1.0)) + " |\n";
    }
  }
  return text;
}

void write_into(const std::string& page, const std::string& table) {
  std::ifstream in(page);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string open = "<!-- measured: interfaces -->\n", close = "<!-- end of measured -->";
  const std::size_t begin = text.find(open), end = text.find(close);
  if (begin == std::string::npos || end == std::string::npos || end < begin) {
    throw std::runtime_error(page + ": the marks of the table are missing");
  }
  text.replace(begin + open.size(), end - begin - open.size(), table);
  std::ofstream(page) << text;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool quick = std::find(arguments.begin(), arguments.end(), "--quick") != arguments.end();
    const auto page = std::find(arguments.begin(), arguments.end(), "--write");
    const Setup s;
    const std::vector<Ring> rings = {
        {"elastic", bench::intact_points<2>(s.material, 0.5), bench::mixed_loading<2>(bench::paper_increment)},
        {"yielding", bench::yielding_points<2>(s.material), bench::mixed_loading<2>(bench::paper_increment)}};
    const std::string text = table(s, rings, quick);
    std::cout << text;
    if (page != arguments.end() && page + 1 != arguments.end()) write_into(*(page + 1), text);
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
  return 0;
}
