// Patch tests of the particle operator: static equilibria with a known stress, on many arrangements of the particles.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fpz/specimen/placing.hpp"
#include "fpz/sph/options.hpp"
#include "fpz/types.hpp"

namespace fpz::report {

struct NamedPattern {
  std::string name;
  specimen::Pattern pattern;
};

/// Lattices (along the axes, turned, moved) and scattered particles; rings are for discs.
[[nodiscard]] std::vector<NamedPattern> strip_patterns();
[[nodiscard]] std::vector<NamedPattern> disc_patterns();

/// Of stresses: Frobenius norm of the error over the largest stress of the exact field. NaN where nothing was measured.
struct Errors {
  double rms = 0.0, worst = 0.0;
};

class ErrorSum {
 public:
  void add(const Tensor<double, 2>& difference, double largest_stress);
  void add(double error);
  [[nodiscard]] Errors errors() const;

 private:
  double squares_ = 0.0, worst_ = 0.0, count_ = 0.0;
};

enum class PatchField { tension, bending };

/// Where the particles are: more than three spacings below the surface (disc: within 0.6 of the radius), or nearer to
/// it.
struct PatchErrors {
  Errors inside, surface;
  Errors ends;  ///< outside the middle half of a strip
};

using BothFields = std::array<PatchErrors, 2>;  ///< tension, bending

enum class StripEnds {
  traction,  ///< the exact traction acts on them
  held       ///< the particles of 2.4 spacings have the exact displacement, as under a bonded grip
};

/// Strip of height 1 and length 2 with `rows` spacings across, under even tension along it or pure bending. The middle
/// half of its length counts.
[[nodiscard]] BothFields strip_errors(const specimen::Pattern& pattern, int rows, StripEnds ends,
                                      sph::Gradient gradient = sph::Gradient::consistent);

/// Disc of diameter 1 under the tractions of even tension, and of a stress that is linear across it.
[[nodiscard]] BothFields disc_errors(const specimen::Pattern& pattern, int rows);

enum class DiscLoad {
  pressure,  ///< even and radial, over the chord of the platens
  platens    ///< those of the scene
};

/// data/scenes/disc.json against the closed form of even pressure with the same load, within 0.6 of the radius: errors
/// over the stress at the centre under line loads, 2P/(pi D t) across and 6P/(pi D t) along the load.
struct DiscErrors {
  Errors across, along;
  double centre = 0.0;  ///< mean of the stress across within two spacings of the centre, over that of the closed form
};
[[nodiscard]] DiscErrors loaded_disc_errors(const specimen::Pattern& pattern, double spacing, DiscLoad load);

/// Stress at x in a disc of this radius under an even radial pressure over two opposite arcs about the y axis of this
/// half-angle, whose resultants are 1 N per metre (Pa). Flamant's solution for pairs of line loads (Michell 1900),
/// integrated over the arcs.
[[nodiscard]] Tensor<double, 2> stress_under_pressure(const specimen::Point& x, double radius, double half_angle);

/// What a solver of the normal equations of the bonds' vectors needs.
struct SolverCost {
  std::string solver;
  std::size_t particles = 0;
  double seconds = 0.0;   ///< of the processor
  double memory = 0.0;    ///< peak beyond the equations, MiB
  double entries = 0.0;   ///< in factors or preconditioner
  double residual = 0.0;  ///< relative
  bool solved = false;
};
/// On a strip of 2 rows x rows particles. Each solver runs in a process of its own.
[[nodiscard]] std::vector<SolverCost> solver_costs(const NamedPattern& pattern, int rows, bool all_solvers);

/// Set-up of a whole run (vectors, stability limit), as its constructor does it.
[[nodiscard]] SolverCost setup_cost(const NamedPattern& pattern, int rows, sph::Gradient gradient);

}  // namespace fpz::report
