#include "zone.hpp"

#include <cmath>

#include "fpz/calibration/mid_line.hpp"
#include "fpz/integrators/accurate.hpp"
#include "fpz/integrators/implicit.hpp"
#include "jet.hpp"

namespace fpz::calibration {

template <class T, class P>
Report follow_zone(const CohesiveLaw<P>& law, const SeriesCompliance<P>& series, const Options& options,
                   const CohesiveState<T, 2>& begin, const Drive<T, 2>& drive, CohesiveState<T, 2>& end) {
  return fpz::detail::integrate_accurate(Zone(law, series), options, begin, drive, end);
}

template <class T, class P>
Status open_zone(const CohesiveLaw<P>& law, const CohesiveState<T, 1>& begin, const T& jump, CohesiveState<T, 1>& end) {
  if (!std::isfinite(value(jump))) return Status::invalid_input;
  const SeriesCompliance<P> rigid{P(0.0), P(0.0)};
  const Drive<T, 1> drive{begin.jump, Vec<T, 1>::Constant(jump)};
  return fpz::detail::integrate_implicit(Zone(law, rigid), Options(), begin, drive, end).status;
}

// Plain numbers, the derivative along the way, and those with respect to the parameters.
template Report follow_zone(const CohesiveLaw<double>&, const SeriesCompliance<double>&, const Options&,
                            const CohesiveState<double, 2>&, const Drive<double, 2>&, CohesiveState<double, 2>&);
template Report follow_zone(const CohesiveLaw<double>&, const SeriesCompliance<double>&, const Options&,
                            const CohesiveState<Dual<1>, 2>&, const Drive<Dual<1>, 2>&, CohesiveState<Dual<1>, 2>&);
template Report follow_zone(const CohesiveLaw<Jet>&, const SeriesCompliance<Jet>&, const Options&,
                            const CohesiveState<Jet, 2>&, const Drive<Jet, 2>&, CohesiveState<Jet, 2>&);
template Status open_zone(const CohesiveLaw<double>&, const CohesiveState<Dual<1>, 1>&, const Dual<1>&,
                          CohesiveState<Dual<1>, 1>&);
template Status open_zone(const CohesiveLaw<MidLine::Slope>&, const CohesiveState<MidLine::Slope, 1>&,
                          const MidLine::Slope&, CohesiveState<MidLine::Slope, 1>&);

}  // namespace fpz::calibration
