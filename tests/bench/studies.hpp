// What the report is made of: each study computes, nothing here prints or draws.
#pragma once

#include <array>

#include "walk.hpp"

namespace fpz::bench {

/// Slope of log(y) over log(x) by least squares; NaN with fewer than two points.
[[nodiscard]] double fitted_order(const std::vector<std::pair<double, double>>& points);

[[nodiscard]] Case<2> four_stage_case();
[[nodiscard]] Case<2> mixed_case();
[[nodiscard]] Case<2> compressive_case();

// (a) Error against increment and time.

struct PathRun {
  Method method = Method::implicit;
  double tolerance = 0.0;
  double increment = 0.0;  ///< 0: every stage is one update
  WalkError error;
  double seconds = 0.0;  ///< of the whole path; 0 when it failed or was not timed
};

struct PathStudy {
  std::string name, title;
  std::vector<PathRun> runs;
};

[[nodiscard]] PathStudy study_path(const Case<2>& c, bool quick);

/// `implicit` on the four-stage path with increments whose largest component is 9e-5.
[[nodiscard]] WalkError study_coarse_implicit();

// (b) Requested against achieved.

struct ToleranceRow {
  std::string path;
  double tolerance = 0.0;
  std::vector<WalkError> at;  ///< one per entry of output_increments()

  [[nodiscard]] bool met() const;
};

[[nodiscard]] std::vector<double> output_increments(bool quick);
[[nodiscard]] std::vector<ToleranceRow> study_tolerance(bool quick);

// (c) Time to a given error.

struct Contender {
  std::string title;
  std::string setting;
  WalkError error;
  double seconds = 0.0;
};

/// Fastest settings that keep the four-stage path within `target` of sigma_t0. The first entry is `paper`.
[[nodiscard]] std::vector<Contender> study_time_to_error(const Case<2>& c, double target);

// (d) Plane scan against closed form.

struct OnsetRow {
  int dim = 2;
  double degrees = 0.0;          ///< 0: closed form
  double angle_error_deg = 0.0;  ///< largest over the samples
  double stress_error = 0.0;     ///< largest relative error of the stress at onset
  double nanoseconds = 0.0;      ///< per plane search
};

struct OnsetStudy {
  int samples_2d = 0, samples_3d = 0;
  std::vector<OnsetRow> rows;
};

[[nodiscard]] OnsetStudy study_onset();

// (e) One step of Algorithm 1.

struct ErrorMap {
  Method method = Method::paper;
  double damage = 0.0;              ///< D at the begin of the step
  std::vector<double> log10_error;  ///< traction over sigma_t0, row by row (du_s outer); NaN where it failed
  double failed_share = 0.0;
  double within_1_percent = 0.0;  ///< share of the map
  double at_paper_step = 0.0;     ///< error at the jump increments of the paper's path
};

struct MapStudy {
  int size = 0;                        ///< points along each axis
  double low = -6, high = 0;           ///< log10 of du/delta0
  std::array<double, 2> paper_step{};  ///< (du_n, du_s)/delta0 of the paper's increment
  std::vector<ErrorMap> maps;
};

[[nodiscard]] MapStudy study_maps();

// (f) Residual histories.

struct History {
  std::string title;
  bool converged = false;
  std::vector<double> residuals;  ///< scaled, first entry before the first correction
  std::vector<double> orders;     ///< log(r_{k+1}/r_k)/log(r_k/r_{k-1}) while above rounding
  std::vector<double> ratios;     ///< r_{k+1}/r_k while above rounding
};

struct NewtonStudy {
  std::vector<History> implicit, paper;
};

[[nodiscard]] NewtonStudy study_newton();

// (g) Times of single updates.

struct Timing {
  std::string name;
  double nanoseconds = 0.0;  ///< smallest over the repetitions, per update (per point in a batch)
  double iterations = 0.0;
  std::int64_t order = 0;  ///< of registration
};

[[nodiscard]] std::vector<Timing> study_timings();

// (h) Alternatives.

struct AlternativeRun {
  std::string method;
  double tolerance = 0.0;
  WalkError error;
  double seconds = 0.0;
};

struct AlternativeStudy {
  std::vector<AlternativeRun> ordinary, stiff, separated;
  double stiff_reference_check = 0.0;  ///< difference of the two tightest runs that make up the stiff reference
  double sa_over_za = 0.0;  ///< time of the (S, a) solve over that of the (z, a) solve, one call after the other
  double sa_over_za_waiting = 0.0;  ///< the same, each call waiting for the result of the one before
  double sa_iterations = 0.0, za_iterations = 0.0;
};

[[nodiscard]] AlternativeStudy study_alternatives();

/// Seconds at which a run list reaches `error`, by interpolation in log-log; NaN outside the list.
[[nodiscard]] double seconds_at_error(const std::vector<AlternativeRun>& runs, const std::string& method, double error);

}  // namespace fpz::bench
