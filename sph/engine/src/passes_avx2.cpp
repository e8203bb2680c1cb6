// The inner loops for this instruction set (flags: CMakeLists.txt).
#define FPZ_SPH_ISA avx2
#define FPZ_SPH_WIDTH 4
#include "passes.inl"

namespace fpz::sph::detail {

template <>
const Passes<2>& avx2_passes<2>(int kernel, int momentum, bool several) {
  return avx2::choose(kernel, momentum, several);
}

}  // namespace fpz::sph::detail
