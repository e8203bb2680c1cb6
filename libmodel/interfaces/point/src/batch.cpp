#include "fpz/point/batch.hpp"

#include <algorithm>
#include <exception>
#include <string>

#include "explain.hpp"
#include "fpz/energy.hpp"
#include "fpz/point/point_update.hpp"
#include "fpz/threads.hpp"
#include "fpz/update.hpp"

namespace fpz::point {

namespace {

/// The points of one thread: what is kept from one to the next.
template <int Dim>
class Worker {
 public:
  Worker(const Behaviour& b, const BatchArrays& a) : behaviour_(b), arrays_(a), material_(b.material) {}

  BatchReport report;

  void update_point(std::size_t i) {
    if (arrays_.lengths != nullptr && !take_length(arrays_.lengths[i])) return keep(i, {Status::invalid_input});
    Tensor<double, Dim> increment;
    const double* given = arrays_.strain_increments.of(i);
    for (int k = 0; k < tensor_size<Dim>; ++k) increment[k] = given[k * arrays_.strain_increments.component];
    const double* begin = arrays_.begin.of(i);
    const std::ptrdiff_t step = arrays_.begin.component;
    if (begin[flag * step] == 0.0) {
      if (stays_intact(i, increment)) return;
      load_intact(begin, step);
    } else if (!load<Dim>(begin, step, begin_)) {
      return keep(i, {Status::invalid_input});
    }
    const Report point =
        arrays_.tangents.data == nullptr
            ? fpz::update<Dim>(material_, behaviour_.options, begin_, increment, end_)
            : fpz::update_with_tangent<Dim>(material_, behaviour_.options, begin_, increment, end_, tangent_);
    if (!point.ok()) return keep(i, point);
    store<Dim>(end_, arrays_.end.of(i), arrays_.end.component);
    if (arrays_.tangents.data != nullptr) store_tangent(i, tangent_);
    if (arrays_.energies.data != nullptr) store_energies(i);
    book(i, point, end_.cracked);
  }

 private:
  static constexpr std::ptrdiff_t flag = 2 * tensor_size<Dim>;  // where `cracked` is

  /// The short way of most points: nothing of the crack is read, and nothing is written that is there already.
  [[nodiscard]] bool stays_intact(std::size_t i, const Tensor<double, Dim>& increment) {
    const double* from = arrays_.begin.of(i);
    Tensor<double, Dim> old, strain, stress;
    for (int k = 0; k < tensor_size<Dim>; ++k) old[k] = from[k * arrays_.begin.component];
    if (!fpz::detail::stays_intact<Dim>(material_, old, increment, strain, stress)) return false;
    double* to = arrays_.end.of(i);
    const std::ptrdiff_t step = arrays_.end.component;
    for (int k = 0; k < tensor_size<Dim>; ++k) {
      to[k * step] = strain[k];
      to[(tensor_size<Dim> + k) * step] = stress[k];
    }
    if (to != from) clear_crack(to, step);
    if (arrays_.tangents.data != nullptr) store_tangent(i, elastic_);
    if (arrays_.energies.data != nullptr) {
      end_.cracked = false;
      end_.strain = strain;
      end_.stress = stress;
      store_energies(i);
    }
    if (arrays_.statuses != nullptr) arrays_.statuses[i] = static_cast<int>(Status::ok);
    return true;
  }

  static void clear_crack(double* state, std::ptrdiff_t step) {
    constexpr auto size = static_cast<std::ptrdiff_t>(state_size<Dim>);
    if (step == 1) {  // of known length: a few wide stores
      std::fill_n(state + flag, size - flag, 0.0);
    } else {
      for (std::ptrdiff_t k = flag; k < size; ++k) state[k * step] = 0.0;
    }
  }

  /// What an update of an uncracked point reads.
  void load_intact(const double* from, std::ptrdiff_t step) {
    for (int k = 0; k < tensor_size<Dim>; ++k) {
      begin_.strain[k] = from[k * step];
      begin_.stress[k] = from[(tensor_size<Dim> + k) * step];
    }
    begin_.cracked = false;
  }

  [[nodiscard]] bool take_length(double length) {
    if (length == material_.rve_length) return true;
    if (!(length > 0.0) || !std::isfinite(length)) return false;
    set_rve_length(material_, length);
    return true;
  }

  void store_tangent(std::size_t i, const Tangent<Dim>& t) {
    double* to = arrays_.tangents.of(i);
    for (int r = 0; r < tensor_size<Dim>; ++r) {
      for (int c = 0; c < tensor_size<Dim>; ++c) {
        to[(r * tensor_size<Dim> + c) * arrays_.tangents.component] = t(r, c);
      }
    }
  }

  void store_energies(std::size_t i) {
    double* to = arrays_.energies.of(i);
    to[0] = stored_energy(material_, end_);
    to[arrays_.energies.component] = dissipated_energy(material_, end_);
  }

  /// A point that has failed: the numbers of its begin, whatever they are.
  void keep(std::size_t i, const Report& point) {
    const double* from = arrays_.begin.of(i);
    double* to = arrays_.end.of(i);
    for (std::size_t k = 0; k < state_size<Dim>; ++k) {
      const auto n = static_cast<std::ptrdiff_t>(k);
      to[n * arrays_.end.component] = from[n * arrays_.begin.component];
    }
    book(i, point, from[flag * arrays_.begin.component] == 1.0);
  }

  void book(std::size_t i, const Report& point, bool cracked) {
    if (arrays_.statuses != nullptr) arrays_.statuses[i] = static_cast<int>(point.status);
    report.add(i, point, cracked);
  }

  const Behaviour& behaviour_;
  const BatchArrays& arrays_;
  Material<double> material_;
  State<double, Dim> begin_;
  State<double, Dim> end_;
  Tangent<Dim> tangent_;
  Tangent<Dim> elastic_ = elastic_tangent<Dim>(behaviour_.material.bulk);
};

/// The message of the first point that failed: its begin is still there, in `end`.
template <int Dim>
void explain_first(const Behaviour& behaviour, const BatchArrays& a, const BatchReport& report) {
  const std::size_t i = report.first_failed;
  Behaviour b = behaviour;
  if (a.lengths != nullptr) b.parameters.rve_length = a.lengths[i];
  State<double, Dim> begin;
  Tensor<double, Dim> increment;
  for (int k = 0; k < tensor_size<Dim>; ++k) {
    increment[k] = a.strain_increments.of(i)[k * a.strain_increments.component];
  }
  if (!load<Dim>(a.end.of(i), a.end.component, begin)) {
    set_last_message(std::string("invalid_input: ") + not_a_state);
  } else if (!(b.parameters.rve_length > 0.0) || !std::isfinite(b.parameters.rve_length)) {
    set_last_message("invalid_input: length " + std::to_string(b.parameters.rve_length) + ": must be > 0");
  } else {
    explain<Dim>(b, begin, increment, report.first_status);
  }
  set_last_message("point " + std::to_string(i) + ": " + last_message());
}

}  // namespace

template <int Dim>
BatchReport update_batch(const Behaviour& behaviour, const BatchArrays& arrays, int threads) noexcept {
  BatchReport total;
  const auto points = static_cast<std::ptrdiff_t>(arrays.points);
  [[maybe_unused]] const int team = thread_count(threads);
#pragma omp parallel num_threads(team) if (team > 1 && points > points_at_once)
  {
    Worker<Dim> worker(behaviour, arrays);
#pragma omp for schedule(dynamic, points_at_once) nowait
    for (std::ptrdiff_t i = 0; i < points; ++i) worker.update_point(static_cast<std::size_t>(i));
#pragma omp critical(fpz_point_update_batch)
    total.add(worker.report);
  }
  try {
    if (!total.ok()) explain_first<Dim>(behaviour, arrays, total);
  } catch (const std::exception& e) {
    set_last_message(e.what());
  }
  return total;
}

template BatchReport update_batch<2>(const Behaviour&, const BatchArrays&, int) noexcept;
template BatchReport update_batch<3>(const Behaviour&, const BatchArrays&, int) noexcept;

}  // namespace fpz::point
