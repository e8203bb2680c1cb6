// Many points in one call, on memory that the caller owns.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

#include "fpz/tangent.hpp"
#include "fpz/update.hpp"

namespace fpz {

/// What happened to a batch. Points that fail keep their begin state; the others are updated all the same.
struct BatchReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t failed = 0;            ///< number of points that failed
  std::size_t first_failed = none;   ///< lowest index of a failed point, whatever the number of threads
  Status first_status = Status::ok;  ///< its status
  std::size_t cracked = 0;           ///< points cracked at the end
  std::size_t new_cracks = 0;        ///< points that cracked in this call
  long long iterations = 0;          ///< sum over all points

  [[nodiscard]] bool ok() const { return failed == 0; }

  /// Counts one point.
  void add(std::size_t index, const Report& point, bool is_cracked) {
    iterations += point.iterations;
    if (is_cracked) ++cracked;
    if (point.ok()) {
      if (point.onset) ++new_cracks;
      return;
    }
    ++failed;
    if (index >= first_failed) return;
    first_failed = index;
    first_status = point.status;
  }
  /// Adds the report of other points.
  void add(const BatchReport& part) {
    if (part.first_failed < first_failed) {
      first_failed = part.first_failed;
      first_status = part.first_status;
    }
    failed += part.failed;
    cracked += part.cracked;
    new_cracks += part.new_cracks;
    iterations += part.iterations;
  }
};

/// Updates every point of `begin` by its strain increment into `end` (see update()). All spans have one length; begin
/// and end may be the same memory. With `tangents` (empty, or of that length) the consistent tangents are written too.
/// threads = 0 takes all that OpenMP offers. The result does not depend on the number of threads. Throws
/// std::invalid_argument when the lengths differ. To see why a point failed, fill a Capture (capture.hpp) with
/// begin[first_failed] and its increment.
template <int Dim>
[[nodiscard]] BatchReport update_batch(const Material<double>& m, const Options& o,
                                       std::span<const State<double, Dim>> begin,
                                       std::span<const Tensor<double, Dim>> strain_increments,
                                       std::span<State<double, Dim>> end, std::span<Tangent<Dim>> tangents = {},
                                       int threads = 0);

}  // namespace fpz
