#include "fpz/batch.hpp"

#include <stdexcept>

#include "fpz/threads.hpp"

namespace fpz {

template <int Dim>
BatchReport update_batch(const Material<double>& m, const Options& o, std::span<const State<double, Dim>> begin,
                         std::span<const Tensor<double, Dim>> strain_increments, std::span<State<double, Dim>> end,
                         std::span<Tangent<Dim>> tangents, int threads) {
  const std::size_t size = begin.size();
  if (strain_increments.size() != size || end.size() != size || (!tangents.empty() && tangents.size() != size)) {
    throw std::invalid_argument("update_batch: begin, strain_increments, end (and tangents) must have the same length");
  }
  BatchReport total;
  const auto points = static_cast<std::ptrdiff_t>(size);
  [[maybe_unused]] const int team = thread_count(threads);
#pragma omp parallel num_threads(team) if (team > 1 && points > points_at_once)
  {
    BatchReport part;
#pragma omp for schedule(dynamic, points_at_once) nowait
    for (std::ptrdiff_t i = 0; i < points; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Report point = tangents.empty()
                               ? update<Dim>(m, o, begin[k], strain_increments[k], end[k])
                               : update_with_tangent<Dim>(m, o, begin[k], strain_increments[k], end[k], tangents[k]);
      part.add(k, point, end[k].cracked);
    }
#pragma omp critical(fpz_update_batch)
    total.add(part);
  }
  return total;
}

template BatchReport update_batch<2>(const Material<double>&, const Options&, std::span<const State<double, 2>>,
                                     std::span<const Tensor<double, 2>>, std::span<State<double, 2>>,
                                     std::span<Tangent<2>>, int);
template BatchReport update_batch<3>(const Material<double>&, const Options&, std::span<const State<double, 3>>,
                                     std::span<const Tensor<double, 3>>, std::span<State<double, 3>>,
                                     std::span<Tangent<3>>, int);

}  // namespace fpz
