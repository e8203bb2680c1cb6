// Every softening law of the list against what a law is: derivatives against differences, areas and energies against
// quadrature, pieces against themselves.
#include "fpz/law/softening.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "fpz/law/cohesive_law.hpp"
#include "support/materials.hpp"

namespace fpz::test {
namespace {

/// Calls check(law) for the law of each word, for table 1.
void each_law(const std::function<void(const Softening<double>&)>& check) {
  for (const Word<SofteningKind>& word : Words<SofteningKind>::list) {
    SCOPED_TRACE(word.text);
    check(Softening<double>::make(table1_with(word.value)));
  }
}

/// Displacements at which the laws are looked at, in units of their length: none of them on a kink.
constexpr double places[] = {0.01, 0.31, 0.77, 0.83, 1.9, 3.5, 3.7, 9.0};

/// Simpson's rule between the kinks of w(kappa), 0 to `end`, of f(w, piece).
double integral(const Softening<double>& law, double end, const std::function<double(double, int)>& f) {
  double sum = 0.0;
  double w = 1.0;
  double from = 0.0;
  while (from < end) {
    const int piece = law.piece(w);
    double to = end;
    if (law.piece_end(piece) >= 0.0) {  // the kink by bisection, which needs nothing but after()
      double hi = end;
      double lo = from;
      for (int k = 0; k < 200; ++k) {
        const double mid = 0.5 * (lo + hi);
        (law.after(piece, w, mid - from) > law.piece_end(piece) ? lo : hi) = mid;
      }
      to = hi;
    }
    const int parts = 20000;
    const double h = (to - from) / parts;
    for (int k = 0; k <= parts; ++k) {
      const double weight = k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum += weight * h / 3.0 * f(law.after(piece, w, k * h), piece);
    }
    w = to < end ? law.piece_end(piece) : 0.0;
    from = to;
  }
  return sum;
}

TEST(Softening, WordsAndKindsAgree) {
  EXPECT_EQ(to_string(SofteningKind{}), std::string("exponential"));
  EXPECT_EQ(from_word<SofteningKind>("exponential"), softening_kind<ExponentialSoftening>);
  EXPECT_EQ(from_word<SofteningKind>("bilinear"), softening_kind<BilinearSoftening>);
  EXPECT_FALSE(from_word<SofteningKind>("linear-ish"));
  Parameters p = table1();
  EXPECT_TRUE(std::holds_alternative<ExponentialSoftening<double>>(Softening<double>::make(p).law));
  p.choices.softening = softening_kind<BilinearSoftening>;
  EXPECT_TRUE(std::holds_alternative<BilinearSoftening<double>>(Softening<double>::make(p).law));
}

TEST(Softening, StartsWholeAndFalls) {
  each_law([](const Softening<double>& law) {
    double last = 1.0;
    for (const double x : places) {
      const double w = law.after(1.0, x * law.length());
      EXPECT_GE(w, 0.0);
      EXPECT_TRUE(w < last || (w == 0.0 && last == 0.0));
      last = w;
    }
    EXPECT_LT(law.after(1.0, 50.0 * law.length()), 1e-12);
    EXPECT_EQ(law.piece(1.0), 0);
  });
}

TEST(Softening, TwoStepsAreOne) {
  each_law([](const Softening<double>& law) {
    for (const double a : places) {
      for (const double b : places) {
        const double once = law.after(1.0, (a + b) * law.length());
        const double twice = law.after(law.after(1.0, a * law.length()), b * law.length());
        EXPECT_NEAR(twice, once, 1e-14);
      }
    }
  });
}

TEST(Softening, DerivativesAgainstDifferences) {
  each_law([](const Softening<double>& law) {
    const double h = 1e-4 * law.length();
    double steepest = 0.0;
    for (const double x : places) {
      const double w = law.after(1.0, x * law.length());
      const int k = law.piece(w);
      const double up = law.after(1.0, x * law.length() + h);
      const double down = law.after(1.0, x * law.length() - h);
      EXPECT_NEAR(law.slope(k, w), (up - down) / (2.0 * h), 1e-7 / law.length());
      EXPECT_NEAR(law.curvature(k, w), (up - 2.0 * w + down) / (h * h), 1e-6 / (law.length() * law.length()));
      EXPECT_NEAR(law.loss(k, w, 3e-9), -law.slope(k, w) * 3e-9, 1e-15);
      const Dual<1> dual = law.after(Dual<1>(1.0), Dual<1>::seed(x * law.length(), 0));
      EXPECT_EQ(dual.val, w);
      EXPECT_NEAR(dual.grad[0], law.slope(k, w), 1e-14 / law.length());
      steepest = std::max(steepest, -law.slope(k, w));
    }
    const double begin = -law.slope(0, 1.0);
    EXPECT_NEAR(std::max(steepest, begin), 1.0 / law.shortest_length(), 1e-12 / law.length());
  });
}

TEST(Softening, AreasAgainstQuadrature) {
  each_law([](const Softening<double>& law) {
    const auto w_itself = [](double w, int) { return w; };
    EXPECT_NEAR(law.area(), table1().delta0, 1e-20);  // one meaning of delta0 for all laws
    EXPECT_NEAR(integral(law, 60.0 * law.length(), w_itself), law.area(), 1e-9 * law.area());
    for (const double x : places) {
      EXPECT_NEAR(law.area_to(x * law.length()), integral(law, x * law.length(), w_itself), 1e-11 * law.area());
    }
  });
}

/// The energy that a dissipation constant in both parts gives is int (plastic w + damage |w'|) d(kappa), whichever way
/// it is summed.
TEST(Softening, EnergiesAgainstQuadrature) {
  const Dissipation<double> d{0.6e6, 0.02};
  each_law([&](const Softening<double>& law) {
    const auto exact = [&](double w, int k) { return d.plastic * w - d.damage * law.slope(k, w); };
    const auto in_measure = [&](double w, int k) { return law.measure_rate(k, w) * law.density(k, w, d); };
    for (const double x : places) {
      const double end = x * law.length();
      const double energy = integral(law, end, exact);
      EXPECT_NEAR(integral(law, end, in_measure), energy, 1e-12 * energy);
      EXPECT_NEAR(law.dissipated(d, d, 1.0, law.after(1.0, end)), energy, 1e-9 * energy);
      const double w = law.after(1.0, end);
      const int k = law.piece(w);
      EXPECT_NEAR(law.measure_rate(k, w), -law.measure() * law.slope(k, w), 1e-12 * law.measure() / law.length());
    }
  });
}

TEST(Softening, PiecesEndWhereTheNextBegins) {
  each_law([](const Softening<double>& law) {
    int k = 0;
    for (double end = law.piece_end(0); end >= 0.0; end = law.piece_end(k)) {
      EXPECT_EQ(law.piece(end), k + 1);
      EXPECT_EQ(law.piece(end + 1e-12), k);
      ++k;
    }
    EXPECT_EQ(law.piece(1e-300), std::max(k - 1, 0));
  });
}

/// A law can be given to the cohesive zone directly, without the choice at run time.
TEST(Softening, StaticLawGivesTheSameBits) {
  const Parameters p = table1();
  const auto fixed = CohesiveLaw<double, HyperbolicSurface<double>, ExponentialSoftening<double>>::make(p);
  const CohesiveLaw<double> chosen = make_cohesive_law(p);
  for (const double x : places) {
    EXPECT_EQ(fixed.softening.after(1.0, x * p.delta0), chosen.softening.after(1.0, x * p.delta0));
  }
}

}  // namespace
}  // namespace fpz::test
