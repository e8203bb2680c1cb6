// Memory that a client has not set: under valgrind a use of it is an error (CMakeLists.txt).
#include <memory>
#include <numeric>

#include "interfaces/generic/generic_call.hpp"
#include "support/materials.hpp"

namespace fpz {
namespace {

TEST(GenericUntouched, NothingUnsetIsUsed) {
  using Function = int (*)(test::ClientData*);
  const auto f = reinterpret_cast<Function>(test::find_symbol("Fpz_Tridimensional"));
  const std::vector<double> properties = test::material_properties_of(test::table1());
  std::vector<double> g0(6, 0.0), g1(6, 0.0), f0(6, 0.0), i0(26, 0.0);
  const std::unique_ptr<double[]> k(new double[36]), f1(new double[6]), i1(new double[26]), unset(new double[9]);
  int cracked = 0;
  for (int step = 0; step < 40; ++step) {
    g1[0] += 6e-5;
    g1[3] += step < 20 ? 0.0 : 6e-5;
    for (const double wanted : {-1.0, -2.0, -3.0, 0.0, 1.0, 2.0, 3.0, 4.0}) {
      std::unique_ptr<double[]> energy(new double[4]);
      k[0] = wanted;
      test::ClientData d{
          nullptr,
          unset[0],
          k.get(),
          nullptr,
          &unset[1],
          {g0.data(), f0.data(), &unset[2], &unset[5], i0.data(), &energy[0], &energy[1], &unset[3]},
          {g1.data(), f1.get(), &unset[4], properties.data(), i1.get(), &energy[2], &energy[3], &unset[6]}};
      ASSERT_EQ(f(&d), 1);
      double sum = 0.0;
      if (wanted != 0.0) sum += std::accumulate(k.get(), k.get() + 36, 0.0);
      if (wanted >= 0.0) sum += energy[2] + energy[3] + std::accumulate(f1.get(), f1.get() + 6, 0.0);
      ASSERT_TRUE(std::isfinite(sum));  // valgrind looks at what this depends on
    }
    g0 = g1;
    std::copy(f1.get(), f1.get() + 6, f0.begin());
    std::copy(i1.get(), i1.get() + 26, i0.begin());
    cracked += i0[0] == 1.0 ? 1 : 0;
  }
  EXPECT_GT(cracked, 10);
}

}  // namespace
}  // namespace fpz
