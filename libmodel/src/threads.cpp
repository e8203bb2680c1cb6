#include "fpz/threads.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace fpz {

int thread_count(int requested) {
  if (requested > 0) return requested;
#ifdef _OPENMP
  return omp_get_max_threads();
#else
  return 1;
#endif
}

}  // namespace fpz
