// fpz-beam-bench: time and error of the notched beam's forward model against the density of its mesh. Errors are
// relative to the finest mesh listed; times are the best of three.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>

#include "calibration/specimens.hpp"

namespace {

using namespace fpz::calibration;

template <class F>
double seconds(const F& f) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto start = std::chrono::steady_clock::now();
    f();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

}  // namespace

int main() {
  const fpz::Parameters p = test::concrete();
  NotchedSpecimenTest t;
  t.readings = Eigen::VectorXd::LinSpaced(160, 1e-6, 1.6e-4);
  Eigen::VectorXd finest;
  std::printf("elements  nodes  condense  with dnu  curve   with derivatives  error of the load / peak\n");
  for (const double elements : {80.0, 40.0, 30.0, 20.0, 10.0}) {
    t.specimen = test::beam();
    t.specimen.mesh.ligament_fraction = 1.0 / elements;
    const double plain = seconds([&] { (void)condense(t.specimen, p.poisson_ratio); });
    const double with_nu = seconds([&] { (void)condense(t.specimen, p.poisson_ratio, true); });
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
    const Prediction prediction = predict(t, p, none, true);  // fills the cache
    if (!prediction.ok()) {
      std::printf("%8.0f  %s\n", elements, prediction.failure.c_str());
      return 1;
    }
    const double curve = seconds([&] { (void)predict(t, p, none, false); });
    const double derivatives = seconds([&] { (void)predict(t, p, none, true); });
    if (finest.size() == 0) finest = prediction.values;
    std::printf("%8.0f %6zu %8.3f s %7.3f s %6.3f s %10.3f s %18.1e\n", elements, make_mesh(t.specimen).nodes.size(),
                plain, with_nu, curve, derivatives,
                (prediction.values - finest).cwiseAbs().maxCoeff() / finest.maxCoeff());
  }
  return 0;
}
