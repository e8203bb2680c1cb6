#include "fpz/driver/tangent_check.hpp"

#include <array>
#include <cstdio>
#include <limits>

#include "fpz/driver/dimension.hpp"
#include "fpz/tangent.hpp"
#include "fpz/update.hpp"
#include "point_run.hpp"

namespace fpz::driver {
namespace {

/// Compares the tangent of one step with differences of the update.
template <int Dim>
class StepCheck {
 public:
  static constexpr int N = tensor_size<Dim>;
  using Point = State<double, Dim>;
  using Strain = Tensor<double, Dim>;
  using Column = Tensor<double, Dim>;

  StepCheck(const Material<double>& m, const Options& o, const Point& begin, const Strain& dstrain)
      : material_(m), options_(o), begin_(begin), dstrain_(dstrain) {}

  struct Outcome {
    double error = std::numeric_limits<double>::infinity();  ///< relative, Frobenius, without columns at a kink
    bool kink = false;
  };

  /// A column is at a kink when it disagrees with the central differences and the one-sided ones disagree with each
  /// other.
  [[nodiscard]] Outcome run(double tolerance) const {
    Outcome out;
    Point end;
    Tangent<Dim> c;
    if (!update_with_tangent<Dim>(material_, options_, begin_, dstrain_, end, c).ok()) return out;
    double squares = 0.0;
    for (int j = 0; j < N; ++j) {
      const auto [error, one_sided] = check_column(j, c.col(j), end.stress);
      if (error > tolerance * c.norm() && one_sided > 10.0 * tolerance * c.norm() && std::isfinite(one_sided)) {
        out.kink = true;
      } else {
        squares += error * error;
      }
    }
    out.error = std::sqrt(squares) / c.norm();
    return out;
  }

 private:
  /// Best agreement over many difference steps: large ones suffer from curvature, small ones from rounding.
  [[nodiscard]] std::pair<double, double> check_column(int j, const Column& tangent, const Column& stress) const {
    const double strain_scale =
        material_.law.surface.tensile_strength / (material_.bulk.lambda + 2.0 * material_.bulk.mu);
    double best = std::numeric_limits<double>::infinity();
    double one_sided = best;
    for (double h = 1e-2 * strain_scale; h > 1e-8 * strain_scale; h *= 0.25) {
      Column plus, minus;
      if (!stress_at(j, h, plus) || !stress_at(j, -h, minus)) continue;
      best = std::min(best, (tangent - (plus - minus) / (2.0 * h)).norm());
      one_sided = std::min(one_sided, ((plus - stress) - (stress - minus)).norm() / h);
    }
    return {best, one_sided};
  }

  [[nodiscard]] bool stress_at(int j, double h, Column& stress) const {
    Strain d = dstrain_;
    d[j] += h;
    Point end;
    const Report report = update<Dim>(material_, options_, begin_, d, end);
    stress = end.stress;
    return report.ok();
  }

  const Material<double>& material_;
  const Options& options_;
  const Point& begin_;
  const Strain& dstrain_;
};

template <int Dim>
TangentCheck check(const Test& test, const TangentCheckOptions& options) {
  TangentCheck out;
  const Material<double> material = make_material(test.parameters, test.setting);
  long step = 0;
  const auto hook = [&](const State<double, Dim>& begin, const Tensor<double, Dim>& dstrain, double time) {
    if (step++ % options.every != 0) return;
    ++out.checked;
    const auto found = StepCheck<Dim>(material, test.options, begin, dstrain).run(options.tolerance);
    if (found.kink) ++out.kinks;
    if (!(found.error <= options.tolerance)) ++out.failures;
    if (!(found.error <= out.worst)) {
      out.worst = found.error;
      out.worst_time = time;
    }
  };
  const Result result = run_point<Dim>(test, {}, StepHook<Dim>(hook));
  out.run_status = result.status;
  out.run_message = result.message;
  return out;
}

}  // namespace

std::string TangentCheck::report(const TangentCheckOptions& options) const {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%ld steps checked, %ld above the tolerance %g; in %ld of them some columns lie at a kink (one-sided differences "
      "disagree) and are not judged\nlargest relative error %.3g at time %.9g\n",
      checked, failures, options.tolerance, kinks, worst, worst_time);
  std::string out = text;
  if (run_status != "ok") out += "error: " + run_message + "\n";
  if (checked == 0) out += "error: nothing was checked\n";
  return out + (ok() ? "ok\n" : "FAILED\n");
}

TangentCheck check_tangent(const Test& test, const TangentCheckOptions& options) {
  return with_dimension(test.setting, [&](auto dim) { return check<decltype(dim)::value>(test, options); });
}

}  // namespace fpz::driver
