// The inner loops for this instruction set (flags: CMakeLists.txt).
#define FPZ_SPH_ISA baseline
#include "passes.inl"

namespace fpz::sph::detail {

template <>
const Passes<2>& baseline_passes<2>(int kernel, int momentum) {
  return baseline::choose(kernel, momentum);
}

}  // namespace fpz::sph::detail
