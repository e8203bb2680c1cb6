// The particle method's elastic step as one would write it first: neighbour lists, one particle after the other.
// FROZEN: a yardstick for the engine's loops on whatever machine, so it must not be made faster.
#pragma once

#include <cstddef>
#include <vector>

namespace fpz::bench {

/// A lattice of columns x rows particles, h = 1.2 spacings, without zero-energy control.
class SimpleLoop {
 public:
  SimpleLoop(int columns, int rows);
  void step();
  /// So that nothing is optimised away.
  [[nodiscard]] double sum() const;

 private:
  struct Particle {
    double x, y, vx, vy;
    double gradient[4];  ///< F - I, row by row
    double flux[4];
  };
  struct Bond {
    int to;
    double wx, wy;
  };
  std::vector<Particle> particles_;
  std::vector<std::size_t> begin_;
  std::vector<Bond> bonds_;
  double volume_ = 1e-6, mass_ = 2.4e-3, lambda_ = 16.75e9, mu_ = 18.15e9, dt_ = 1e-7;
};

}  // namespace fpz::bench
