// The inner loops for this instruction set (flags: CMakeLists.txt).
#define FPZ_SPH_ISA baseline
#define FPZ_SPH_WIDTH 2
#include "passes.inl"

namespace fpz::sph::detail {

template <>
const Passes<2>& baseline_passes<2>(int kernel, int momentum, bool several) {
  return baseline::choose(kernel, momentum, several);
}

}  // namespace fpz::sph::detail
