// The 3-D updates in plain doubles, compiled once for all clients.
#include "fpz/continuation.hpp"

namespace fpz {

template Report cohesive_update<double, 3, double>(const CohesiveLaw<double>&, const Options&,
                                                   const CohesiveState<double, 3>&, const Vec<double, 3>&,
                                                   CohesiveState<double, 3>&, Mat<double, 3, 3>*);
template Report detail::update_cracked<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                          const Tensor<double, 3>&, State<double, 3>&);
template State<double, 3> detail::open_crack<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                                const Tensor<double, 3>&, const Tensor<double, 3>&);
template Report update_with_tangent<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                       const Tensor<double, 3>&, State<double, 3>&, Tangent<3>&);
template Report update_controlled<3>(const Material<double>&, const Options&, const State<double, 3>&,
                                     const Tensor<double, 3>&, double, State<double, 3>&, double&);

}  // namespace fpz
