// How an update is integrated, and what it reports.
#pragma once

#include <string>

#include "fpz/parameters.hpp"

namespace fpz {

enum class Method : std::uint8_t {
  paper,     ///< eq 51-61 as printed with its slips repaired: semi-implicit,
             ///< baseline for comparison
  implicit,  ///< backward Euler on the scaled hyperbola, traction continuity
             ///< eliminated; first order, solvable but for snap-back if psi > 0
  accurate   ///< adaptive stiffly stable Rosenbrock method of order 4(3) on the
             ///< rate equations, events located
};

template <>
struct Words<Method> {
  static constexpr Word<Method> list[] = {
      {Method::accurate, "accurate"}, {Method::implicit, "implicit"}, {Method::paper, "paper"}};
};

struct Options {
  Method method = Method::accurate;
  /// accurate: error of traction over sigma_t0 and of D along a whole path. paper: eq 62 (the paper uses 1e-4).
  /// implicit: unused.
  double tolerance = 1e-6;
  /// paper: limit of the traction-continuity loop (eq 57-61).
  int max_iterations = 100;
  /// accurate: limit of sub-steps in one update.
  int max_substeps = 20000;
  /// Onset: 0 takes the closed form (docs/equations.md); otherwise the paper's scan (section 4.1) at this resolution in
  /// degrees.
  double scan_resolution_deg = 0.0;
  /// Of two equally critical conjugate planes, take the one whose normal is closer to this direction. Zero: the fixed
  /// rule of onset.hpp.
  Vec<double, 3> preferred_normal = Vec<double, 3>::Zero();
};

/// Calls f(key, option) for every option, under the keys of captures: enumerations with words, numbers, and a vector.
template <class O, class F>
void visit_options(O& o, F&& f) {
  f("name", o.method);
  f("tolerance", o.tolerance);
  f("max_iterations", o.max_iterations);
  f("max_substeps", o.max_substeps);
  f("scan_degrees", o.scan_resolution_deg);
  f("preferred_normal", o.preferred_normal);
}

/// What is wrong with the numbers of the options, under the keys of visit_options().
[[nodiscard]] Validation validate(const Options& o);

/// Why an integrator cannot follow the cohesive zone of a material, with the way out; empty: it can.
[[nodiscard]] std::string why_unfit(Method method, const MaterialChoices& choices);

struct Report {
  Status status = Status::ok;
  int iterations = 0;  ///< Newton iterations (implicit), traction iterations
                       ///< (paper), steps tried (accurate)
  int substeps = 0;    ///< accepted sub-steps (accurate), parts (implicit), 1 (paper); 0 while a point stays intact
  bool onset = false;  ///< the fracture appeared in this update

  [[nodiscard]] bool ok() const { return status == Status::ok; }
};

}  // namespace fpz
