#include "fpz/specimen/surface_load.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "fpz/specimen/placing.hpp"

namespace {

using namespace fpz::specimen;

TEST(SurfaceLoad, WorksInLinearFieldsAsThePointForces) {
  const Body disc{Disc{Point(0, 0), 0.025}, {}, {}};
  Pattern p;
  p.kind = Pattern::Kind::scattered;
  fpz::sph::Arrangement<2> a = place_specimen(disc, p, 0.001);
  a.group[0] = 0;
  const std::vector<PointForce> forces = {{Point(0.0, 0.025), Point(3.0, -2.0)}, {Point(-0.02, -0.015), Point(0, 5)}};
  const std::vector<Point> shared = share_out(forces, a);
  fpz::Mat<double, 2, 2> wanted = fpz::Mat<double, 2, 2>::Zero(), found = wanted;
  Point sum(0, 0);
  for (const PointForce& f : forces) wanted += f.force * f.at.transpose();
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += shared[i];
    found += shared[i] * a.position[i].transpose();
    const double nearest = std::min((a.position[i] - forces[0].at).norm(), (a.position[i] - forces[1].at).norm());
    EXPECT_TRUE(nearest < 0.003 || shared[i] == Point(0, 0));
  }
  EXPECT_EQ(shared[0], Point(0, 0));
  EXPECT_NEAR((sum - Point(3.0, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((found - wanted).norm(), 0.0, 1e-14);
  EXPECT_THROW((void)share_out({{Point(0, 0.1), Point(1, 0)}}, a), std::invalid_argument);
}

}  // namespace
