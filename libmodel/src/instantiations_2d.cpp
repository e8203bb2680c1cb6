// The 2-D updates in plain doubles, compiled once for all clients.
#include "fpz/continuation.hpp"

namespace fpz {

template Report cohesive_update<double, 2, double>(const CohesiveLaw<double>&, const Options&,
                                                   const CohesiveState<double, 2>&, const Vec<double, 2>&,
                                                   CohesiveState<double, 2>&, Mat<double, 2, 2>*);
template Report detail::update_cracked<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                          const Tensor<double, 2>&, State<double, 2>&);
template State<double, 2> detail::open_crack<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                                const Tensor<double, 2>&, const Tensor<double, 2>&);
template Report update_with_tangent<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                       const Tensor<double, 2>&, State<double, 2>&, Tangent<2>&);
template Report update_controlled<2>(const Material<double>&, const Options&, const State<double, 2>&,
                                     const Tensor<double, 2>&, double, State<double, 2>&, double&);

}  // namespace fpz
