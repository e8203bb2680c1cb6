// Walks a loading path with any update, compares it with the independent reference and times it.
#pragma once

#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "fpz/energy.hpp"

namespace fpz::bench {

/// CPU time of this thread.
[[nodiscard]] inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Smallest CPU time of one call of each job, in seconds. The jobs take turns, so that a busy machine slows all of them
/// alike; each gets about `budget` seconds.
[[nodiscard]] std::vector<double> time_interleaved(const std::vector<std::function<void()>>& jobs,
                                                   double budget = 0.25);

template <int Dim>
struct Case {
  Case(test::Path<Dim> p, std::string t, bool xx = false)
      : path(std::move(p)),
        title(std::move(t)),
        counted_in_xx(xx),
        material(make_material(path.parameters, path.setting)) {
    State<double, Dim> s;
    for (const Tensor<double, Dim>& leg : path.legs) {
      if (!update<Dim>(material, options_of(Method::accurate, 1e-8), s, leg, s).ok()) {
        throw std::runtime_error(path.name + ": no solution");
      }
    }
    normal = test::normal_of(s);
  }

  test::Path<Dim> path;
  std::string title;
  bool counted_in_xx;  ///< increments are sized by d eps_xx as in the paper, not by the largest component
  Material<double> material;
  test::Vector3 normal;  ///< of the crack; tells the reference which conjugate plane to take

  /// Increments of every leg; 0 takes each leg as one.
  [[nodiscard]] std::vector<int> counts(double increment) const {
    std::vector<int> n;
    for (const Tensor<double, Dim>& leg : path.legs) {
      const double size = counted_in_xx ? std::abs(leg[0]) : leg.template lpNorm<Eigen::Infinity>();
      n.push_back(increment > 0.0 ? std::max(1, static_cast<int>(std::ceil(size / increment * (1.0 - 1e-12)))) : 1);
    }
    return n;
  }
};

struct Checkpoint {
  test::Matrix3 stress = test::Matrix3::Zero();
  double damage = 0.0;
};

/// Where a leg of n increments is checked: after these numbers of increments.
[[nodiscard]] inline std::vector<int> checked(int n, int checks) {
  std::vector<int> at;
  const int stride = std::max(1, n / checks);
  for (int done = stride; done < n; done += stride) at.push_back(done);
  at.push_back(n);
  return at;
}

inline constexpr int checks_per_leg = 20;

/// The reference at the checkpoints of a walk, leg after leg.
template <int Dim>
[[nodiscard]] std::vector<Checkpoint> follow_reference(const Case<Dim>& c, const std::vector<int>& counts) {
  static std::map<std::pair<std::string, std::vector<int>>, std::vector<Checkpoint>> known;
  auto& track = known[{c.path.name, counts}];
  if (!track.empty()) return track;
  test::ReferenceIntegrator reference(c.path.parameters, c.path.setting);
  for (std::size_t i = 0; i < c.path.legs.size(); ++i) {
    int done = 0;
    for (const int at : checked(counts[i], checks_per_leg)) {
      reference.advance(test::to_matrix3<Dim>(c.path.legs[i]) * (static_cast<double>(at - done) / counts[i]), c.normal);
      done = at;
      track.push_back({reference.stress(), reference.state().cracked ? 1.0 - reference.state().integrity : 0.0});
    }
  }
  return track;
}

struct WalkError {
  double stress = 0.0;  ///< largest component error met, over sigma_t0
  double damage = 0.0;
  Status status = Status::ok;
  int leg = 0;  ///< where it failed, if it did: leg and fraction of it
  double fraction = 0.0;
  long updates = 0;
  long substeps = 0;  ///< accepted sub-steps of the yielding updates

  [[nodiscard]] bool ok() const { return status == Status::ok; }
  [[nodiscard]] double worst() const { return std::max(stress, damage); }
};

template <int Dim>
void compare(const Case<Dim>& c, const State<double, Dim>& s, const Checkpoint& reference, WalkError& e) {
  test::Matrix3 stress = test::to_matrix3<Dim>(s.stress);
  if constexpr (Dim == 2)
    stress(2, 2) = c.path.setting == Setting::plane_stress ? reference.stress(2, 2) : stress_zz(c.material, s);
  const double difference = (stress - reference.stress).cwiseAbs().maxCoeff() / c.path.parameters.tensile_strength;
  e.stress = std::max(e.stress, std::isfinite(difference) ? difference : 1e300);
  e.damage = std::max(e.damage, std::abs(damage(s) - reference.damage));
}

/// Walks with `update(begin, dstrain, end)` and compares along the way.
template <int Dim, class Update>
[[nodiscard]] WalkError walk(const Case<Dim>& c, const std::vector<int>& counts,
                             const std::vector<Checkpoint>& reference, const Update& update) {
  WalkError e;
  State<double, Dim> s, next;
  std::size_t checkpoint = 0;
  for (std::size_t i = 0; i < c.path.legs.size(); ++i) {
    const Tensor<double, Dim> d = c.path.legs[i] / counts[i];
    int done = 0;
    for (const int at : checked(counts[i], checks_per_leg)) {
      for (; done < at; ++done) {
        const Report r = update(s, d, next);
        if (!r.ok()) {
          e.status = r.status;
          e.leg = static_cast<int>(i);
          e.fraction = static_cast<double>(done) / counts[i];
          return e;
        }
        s = next;
        ++e.updates;
        e.substeps += r.substeps;
      }
      compare(c, s, reference[checkpoint++], e);
    }
  }
  return e;
}

/// Every leg as one update. The inside of a leg is checked too: each checkpoint is reached by one update from the begin
/// of the leg.
template <int Dim, class Update>
[[nodiscard]] WalkError walk_legs(const Case<Dim>& c, const Update& update) {
  const std::vector<int> counts(c.path.legs.size(), checks_per_leg);
  const std::vector<Checkpoint> reference = follow_reference(c, counts);
  WalkError e;
  State<double, Dim> s, next;
  for (std::size_t i = 0; i < c.path.legs.size(); ++i) {
    for (int k = 1; k <= checks_per_leg; ++k) {
      const Report r = update(s, Tensor<double, Dim>(c.path.legs[i] * (static_cast<double>(k) / checks_per_leg)), next);
      if (!r.ok()) {
        e.status = r.status;
        e.leg = static_cast<int>(i);
        return e;
      }
      compare(c, next, reference[i * checks_per_leg + static_cast<std::size_t>(k) - 1], e);
      if (k == checks_per_leg) {
        ++e.updates;
        e.substeps += r.substeps;
      }
    }
    s = next;
  }
  return e;
}

/// The walk without comparisons, to be timed.
template <int Dim, class Update>
[[nodiscard]] State<double, Dim> run_path(const Case<Dim>& c, const std::vector<int>& counts, const Update& update) {
  State<double, Dim> s;
  for (std::size_t i = 0; i < c.path.legs.size(); ++i) {
    const Tensor<double, Dim> d = c.path.legs[i] / counts[i];
    for (int k = 0; k < counts[i]; ++k) {
      if (!update(s, d, s).ok()) return s;
    }
  }
  return s;
}

/// The library's update with fixed options.
template <int Dim>
[[nodiscard]] auto library_update(const Material<double>& m, const Options& o) {
  return [&m, o](const State<double, Dim>& begin, const Tensor<double, Dim>& d, State<double, Dim>& end) {
    return update<Dim>(m, o, begin, d, end);
  };
}

/// Keeps the optimiser from dropping a timed walk.
template <class T>
void keep(const T& x) {
  asm volatile("" : : "r"(&x) : "memory");
}

}  // namespace fpz::bench
