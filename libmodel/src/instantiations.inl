// The updates in plain doubles for the dimension FPZ_DIM, compiled once for all clients; one file per dimension, so
// that they compile side by side.
#include "fpz/update.hpp"
#include "jump_control.inl"
#include "tangent.inl"

namespace fpz {

namespace detail {
template <>
Report update_beyond_elastic<FPZ_DIM>(const Material<double>& m, const Options& o, const State<double, FPZ_DIM>& begin,
                                      const Tensor<double, FPZ_DIM>& dstrain, State<double, FPZ_DIM>& end) {
  return update_any<FPZ_DIM>(m, o, begin, dstrain, end);
}
}  // namespace detail

template Report cohesive_update<double, FPZ_DIM, CohesiveLaw<double>>(const CohesiveLaw<double>&, const Options&,
                                                                      const CohesiveState<double, FPZ_DIM>&,
                                                                      const Vec<double, FPZ_DIM>&,
                                                                      CohesiveState<double, FPZ_DIM>&,
                                                                      Mat<double, FPZ_DIM, FPZ_DIM>*);
template Report update_with_tangent<FPZ_DIM>(const Material<double>&, const Options&, const State<double, FPZ_DIM>&,
                                             const Tensor<double, FPZ_DIM>&, State<double, FPZ_DIM>&,
                                             Tangent<FPZ_DIM>&);
template Report update_controlled<FPZ_DIM>(const Material<double>&, const Options&, const State<double, FPZ_DIM>&,
                                           const Tensor<double, FPZ_DIM>&, double, State<double, FPZ_DIM>&, double&);

}  // namespace fpz
