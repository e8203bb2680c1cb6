// An update takes nothing from the heap. Own executable: it replaces the global operator new, and makes Eigen, which
// calls malloc itself, assert on any allocation.
#define EIGEN_RUNTIME_NO_MALLOC
#ifdef eigen_assert
#error "Eigen was included before its assertion could be replaced"
#endif
namespace fpz::test {
extern long eigen_failures;
}
#define eigen_assert(x)                      \
  do {                                       \
    if (!(x)) ++::fpz::test::eigen_failures; \
  } while (false)

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "support/paths.hpp"

namespace fpz::test {
long eigen_failures = 0;
}

namespace {
std::atomic<long> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  void* p = std::malloc(size > 0 ? size : 1);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

namespace fpz::test {
namespace {

template <int Dim>
void expect_no_allocation(const Path<Dim>& path, Method method, int count, double scan) {
  const Material<double> m = make_material(path.parameters, path.setting);
  Options o;
  o.method = method;
  o.scan_resolution_deg = scan;
  State<double, Dim> s, end;
  Tangent<Dim> tangent;
  for (const Tensor<double, Dim>& leg : path.legs) {
    const Tensor<double, Dim> d = leg / count;
    for (int k = 0; k < count; ++k) {
      const long before = allocations;
      Eigen::internal::set_is_malloc_allowed(false);
      const Report r = update<Dim>(m, o, s, d, end);
      const Report t = update_with_tangent<Dim>(m, o, s, d, end, tangent);
      Eigen::internal::set_is_malloc_allowed(true);
      const long after = allocations;
      ASSERT_EQ(after, before) << path.name << " " << to_string(method) << " " << k;
      ASSERT_EQ(eigen_failures, 0) << path.name << " " << to_string(method) << " " << k;
      if (!r.ok() || !t.ok()) return;  // `paper` fails on these increments; a failure allocates nothing either
      s = end;
    }
  }
}

TEST(NoAllocation, TheCounterCounts) {
  const long before = allocations;
  int* volatile kept = new int(3);  // volatile: a compiler may leave out an allocation that nobody sees
  delete kept;
  const std::vector<double> v(100);
  const double* volatile seen = v.data();
  EXPECT_EQ(*seen, 0.0);
  EXPECT_GE(allocations, before + 2);
  Eigen::internal::set_is_malloc_allowed(false);
  const Eigen::VectorXd x(100);
  Eigen::internal::set_is_malloc_allowed(true);
  EXPECT_GE(eigen_failures, 1);
  eigen_failures = 0;
}

TEST(NoAllocation, InAnyUpdate) {
  for (const Method method : {Method::paper, Method::implicit, Method::accurate}) {
    for (const double scan : {0.0, 5.0}) {
      for (const int count : {3, 50}) {
        for (const Path<2>& path : {four_stage(), mixed_mode(), compressive_shear(), closing(), plane_stress_cycle()}) {
          expect_no_allocation<2>(path, method, count, scan);
        }
        expect_no_allocation<3>(rotating_shear(), method, count, scan);
      }
    }
  }
}

}  // namespace
}  // namespace fpz::test
