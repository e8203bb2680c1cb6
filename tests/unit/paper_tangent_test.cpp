#include <gtest/gtest.h>

#include <cmath>

#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "support/materials.hpp"

namespace fpz::test {
namespace {

/// The tangent of `paper` is that of its discrete update, its unconverged iteration included: against central
/// differences along the mixed-mode stage of the four-stage path at half the paper's increments. Where a difference
/// changes the number of iterations the update jumps by its own tolerance; those points are told by differences of two
/// sizes that disagree.
TEST(PaperTangent, AgreesWithDifferences) {
  const Material<double> m = make_material(table1(), Setting::plane_strain);
  Options o;
  State2 s;
  Tensor<double, 2> d;
  d << 3.6e-3, 0.0, 0.0;
  ASSERT_TRUE(update<2>(m, o, s, d, s).ok());
  o.method = Method::paper;
  o.tolerance = 1e-4;
  d << 1.5e-7, 0.0, 7.5e-7;
  int judged = 0;
  for (int step = 0; step < 200; ++step) {
    State2 end;
    Tangent<2> tangent;
    ASSERT_TRUE(update_with_tangent<2>(m, o, s, d, end, tangent).ok());
    const auto differences = [&](double h) {
      Tangent<2> c;
      for (int k = 0; k < 3; ++k) {
        Tensor<double, 2> up = d;
        Tensor<double, 2> down = d;
        up[k] += h;
        down[k] -= h;
        State2 a, b;
        EXPECT_TRUE(update<2>(m, o, s, up, a).ok() && update<2>(m, o, s, down, b).ok());
        c.col(k) = (a.stress - b.stress) / (2.0 * h);
      }
      return c;
    };
    const Tangent<2> coarse = differences(4e-11);
    const Tangent<2> fine = differences(2e-11);
    if ((coarse - fine).norm() < 1e-5 * fine.norm()) {
      ++judged;
      EXPECT_LE((tangent - fine).norm(), 1e-4 * fine.norm()) << "step " << step;
    }
    s = end;
  }
  EXPECT_GT(judged, 100);
}

}  // namespace
}  // namespace fpz::test
