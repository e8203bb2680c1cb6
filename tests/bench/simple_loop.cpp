#include "simple_loop.hpp"

#include <cmath>

namespace fpz::bench {

SimpleLoop::SimpleLoop(int columns, int rows) {
  constexpr double spacing = 1e-3, h = 1.2;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      particles_.push_back({i * spacing, j * spacing, 1e-6 * i, 1e-6 * j, {}, {}});
      begin_.push_back(bonds_.size());
      for (int dj = -2; dj <= 2; ++dj) {
        for (int di = -2; di <= 2; ++di) {
          const double r = std::sqrt(di * di + dj * dj) / h;
          const bool inside = i + di >= 0 && i + di < columns && j + dj >= 0 && j + dj < rows;
          if (!inside || r == 0.0 || r >= 2.0) continue;
          const double weight = 1e-3 * (2.0 - r) * (2.0 - r);
          bonds_.push_back({(j + dj) * columns + i + di, weight * di, weight * dj});
        }
      }
    }
  }
  begin_.push_back(bonds_.size());
}

void SimpleLoop::step() {
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& p = particles_[i];
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Bond& b = bonds_[k];
      const Particle& q = particles_[static_cast<std::size_t>(b.to)];
      const double dx = q.vx - p.vx, dy = q.vy - p.vy;
      xx += dx * b.wx, xy += dx * b.wy, yx += dy * b.wx, yy += dy * b.wy;
    }
    p.x += dt_ * p.vx, p.y += dt_ * p.vy;
    double* g = p.gradient;
    g[0] += dt_ * xx, g[1] += dt_ * xy, g[2] += dt_ * yx, g[3] += dt_ * yy;
    const double c = 2.0 + g[0] + g[3], s = g[2] - g[1], r = std::sqrt(c * c + s * s);
    const double cosine = c / r, sine = s / r;
    const double exx = cosine * (1.0 + g[0]) + sine * g[2] - 1.0, eyy = cosine * (1.0 + g[3]) - sine * g[1] - 1.0;
    const double exy = 0.5 * (cosine * (g[1] + g[2]) + sine * (g[3] - g[0]));
    const double pressure = lambda_ * (exx + eyy);
    const double sxx = pressure + 2.0 * mu_ * exx, syy = pressure + 2.0 * mu_ * eyy, sxy = 2.0 * mu_ * exy;
    p.flux[0] = cosine * sxx - sine * sxy, p.flux[1] = cosine * sxy - sine * syy;
    p.flux[2] = sine * sxx + cosine * sxy, p.flux[3] = sine * sxy + cosine * syy;
  }
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    Particle& p = particles_[i];
    double fx = 0.0, fy = 0.0;
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Bond& b = bonds_[k];
      const Particle& q = particles_[static_cast<std::size_t>(b.to)];
      fx += (p.flux[0] + q.flux[0]) * b.wx + (p.flux[1] + q.flux[1]) * b.wy;
      fy += (p.flux[2] + q.flux[2]) * b.wx + (p.flux[3] + q.flux[3]) * b.wy;
    }
    p.vx += dt_ * volume_ / mass_ * fx, p.vy += dt_ * volume_ / mass_ * fy;
  }
}

double SimpleLoop::sum() const {
  double s = 0.0;
  for (const Particle& p : particles_) s += p.x + p.vx;
  return s;
}

}  // namespace fpz::bench
