#include "scene_fit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <set>

#include "report/display.hpp"
#include "words.hpp"

namespace fpz::calibration::detail {
namespace {

using Vector = Eigen::VectorXd;

constexpr int most_rounds = 15;
constexpr double first_radius = 0.15;  ///< of the runs around the start, in coordinates: 15 %
constexpr double largest_radius = 0.3;
constexpr double smallest_radius = 0.01;
constexpr double noise_move = 0.002;  ///< of the runs that show the scatter
constexpr int noise_runs = 4;
constexpr double signal_to_noise = 5.0;  ///< of a change of one radius, at least
constexpr double used_within = 1.25;     ///< radii: runs that the surface goes through
constexpr double same_place = 0.2;       ///< radii: a run that near serves in place of another

/// One parameter vector at which all scenes of the fitted sets have been run.
struct Trial {
  Vector y;
  Vector values;  ///< of all fitted scene sets, one after the other
  std::set<std::string> warnings;
  std::string failure;
};

double largest(const Vector& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0; }

class RunFit {
 public:
  RunFit(const Specification& given, const FitOptions& options, const RunScenes& run)
      : given_(given), options_(options), run_(run), generator_(options.seed) {
    for (std::size_t k = 0; k < parameter_info.size(); ++k) {
      const ParameterSetting& p = given.parameters[k];
      if (!p.fitted) continue;
      Coordinate c{static_cast<int>(k), p.lower > 0.0, 0.5 * (p.upper - p.lower)};
      lower_.conservativeResize(lower_.size() + 1);
      upper_.conservativeResize(upper_.size() + 1);
      centre_.conservativeResize(centre_.size() + 1);
      lower_[lower_.size() - 1] = c.of(p.lower);
      upper_[upper_.size() - 1] = c.of(p.upper);
      centre_[centre_.size() - 1] = c.of(p.value);
      coordinates_.push_back(c);
    }
    for (std::size_t k = 0; k < given.data.size(); ++k) {
      if (std::holds_alternative<SceneData>(given.data[k].test)) {
        (given.data[k].role == Role::fit ? fitted_ : predicted_).push_back(k);
      }
    }
    floor_ = Vector::Constant(size(), smallest_radius);
    noise_ = Vector::Zero(value_count());
  }

  SceneFit go() {
    if (fitted_.empty()) return only_predicted();
    std::optional<Vector> earlier;  // the last minimum inside the reach of the runs
    std::string open = "the minimum was not reached";
    for (round_ = 1; round_ <= most_rounds; ++round_) {
      run_design();
      if (round_ == 1 && !trials_.front().failure.empty()) return no_prediction(trials_.front());
      const std::vector<SurfacePoint> points = points_around();
      if (points.size() < static_cast<std::size_t>(size()) + 2) {
        if (!shrink()) break;
        continue;
      }
      surface_ = fit_surface(coordinates_, centre_, radius(), points, order_for(points.size(), size()));
      if (round_ == 1) measure_noise();
      const Specification local = with_surface(*surface_, true);
      const FitResult found = fit(make_problem(local), local_options());
      if (found.status == FitStatus::failed) {
        open = found.message;
        break;
      }
      const Vector y = coordinates_of(found.values);
      const Trial& there = run_at(y);
      if (!there.failure.empty()) {
        if (!shrink()) break;
        continue;
      }
      const double miss = missed_by(found, local, there);
      const bool at_floor = (radius() - floor_).maxCoeff() <= 0.0;
      const bool good = miss <= std::max(0.5, 3.0 * noise_level(found)) || at_floor;
      const bool edge = at_edge(y);
      summary_.words.push_back("round " + std::to_string(round_) + ": " + std::to_string(trials_.size()) +
                               " parameter sets run, " + values_text(found.values) +
                               (edge ? ", at the edge of the runs" : ""));
      if (!good) {
        if (lower_cost(found, local, there)) centre_ = y;
        earlier.reset();
        open = "the surface through the runs misses a new run by " + number(miss, 2) + " standard deviations";
        if (!shrink()) break;
        continue;
      }
      const Vector step = earlier ? Vector(y - *earlier) : Vector();
      centre_ = y;
      if (edge) {
        earlier.reset();
        base_radius_ = std::min(1.5 * base_radius_, largest_radius);
        open = "the minimum still moves";
        continue;
      }
      if (step.size() > 0 && settled(found, step)) return finish(y, "");
      if (step.size() > 0) open = "the minimum still moves by more than its error";
      earlier = y;
      (void)shrink();
    }
    return finish(centre_, open);
  }

 private:
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(coordinates_.size()); }
  [[nodiscard]] Vector radius() const { return floor_.cwiseMax(base_radius_); }

  [[nodiscard]] const SceneData& scenes(std::size_t set) const { return std::get<SceneData>(given_.data[set].test); }

  [[nodiscard]] Eigen::Index value_count() const {
    Eigen::Index n = 0;
    for (const std::size_t k : fitted_) n += given_.data[k].measured.size();
    return n;
  }

  /// The first of `values` are those of the parameters that are fitted.
  [[nodiscard]] Parameters parameters_with(const Vector& values) const {
    Parameters p = given_.start();
    for (std::size_t j = 0; j < coordinates_.size(); ++j) {
      p.*parameter_info[static_cast<std::size_t>(coordinates_[j].place)].member = values[static_cast<Eigen::Index>(j)];
    }
    return p;
  }
  [[nodiscard]] Parameters parameters_of(const Vector& y) const { return parameters_with(values_at(y)); }

  [[nodiscard]] Vector coordinates_of(const Vector& values) const {
    Vector y(size());
    for (Eigen::Index j = 0; j < size(); ++j) y[j] = coordinates_[static_cast<std::size_t>(j)].of(values[j]);
    return y.cwiseMax(lower_).cwiseMin(upper_);
  }

  [[nodiscard]] std::string values_text(const Vector& values) const {
    std::vector<std::string> items;
    for (Eigen::Index j = 0; j < size(); ++j) {
      const auto& p = parameter_info[static_cast<std::size_t>(coordinates_[static_cast<std::size_t>(j)].place)];
      items.push_back(std::string(p.name) + " = " + shown_value(values[j], p.unit));
    }
    return listed(items);
  }

  [[nodiscard]] Vector values_at(const Vector& y) const {
    Vector x(size());
    for (Eigen::Index j = 0; j < size(); ++j) x[j] = coordinates_[static_cast<std::size_t>(j)].value(y[j]);
    return x;
  }

  // ---- Runs

  /// The outcomes of some sets' scenes at each of the points.
  std::vector<std::vector<std::vector<SceneOutcome>>> outcomes_of(const std::vector<std::size_t>& sets,
                                                                  const std::vector<Vector>& points) {
    std::vector<SceneRun> runs;
    for (const Vector& y : points) {
      for (const std::size_t k : sets) {
        for (const SceneSource& s : scenes(k).scenes) runs.push_back({s, parameters_of(y)});
      }
    }
    const std::vector<SceneOutcome> flat = run_(runs, [&](std::size_t done, std::size_t all, double remaining) {
      if (!options_.progress) return;
      const std::string left = std::isnan(remaining) ? "" : ", " + number(remaining, 2) + " s for the others";
      options_.progress({"runs of the scenes, round " + std::to_string(round_),
                         all > 0 ? static_cast<double>(done) / static_cast<double>(all) : 1.0, 0.0,
                         std::to_string(done) + " of " + std::to_string(all) + " done" + left});
    });
    std::vector<std::vector<std::vector<SceneOutcome>>> out;
    std::size_t next = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      auto& at_point = out.emplace_back();
      for (const std::size_t k : sets) {
        const std::size_t count = scenes(k).scenes.size();
        const auto first = flat.begin() + static_cast<std::ptrdiff_t>(next);
        at_point.emplace_back(first, first + static_cast<std::ptrdiff_t>(count));
        next += count;
      }
    }
    return out;
  }

  void run_all(const std::vector<Vector>& points) {
    if (points.empty()) return;
    const auto outcomes = outcomes_of(fitted_, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Trial t{points[i], Vector(value_count()), {}, ""};
      Eigen::Index at = 0;
      for (std::size_t s = 0; s < fitted_.size() && t.failure.empty(); ++s) {
        const Prediction p = readings_of(scenes(fitted_[s]), outcomes[i][s]);
        t.failure = p.failure;
        if (!p.ok()) break;
        t.values.segment(at, p.values.size()) = p.values;
        at += p.values.size();
        for (const SceneOutcome& o : outcomes[i][s]) t.warnings.insert(o.warnings.begin(), o.warnings.end());
      }
      if (!t.failure.empty()) {
        t.failure = "with " + values_text(values_at(t.y)) + ": " + t.failure;
        if (summary_.failed++ == 0) summary_.first_failure = t.failure;
      }
      trials_.push_back(std::move(t));
    }
  }

  const Trial& run_at(const Vector& y) {
    run_all({y});
    return trials_.back();
  }

  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-52 - 1.0; }  // in [-1, 1)

  Vector around(const Vector& reach) {
    Vector y = centre_;
    for (double& x : y) x += uniform() * reach[&x - y.data()];
    return y.cwiseMax(lower_).cwiseMin(upper_);
  }

  /// Runs where there are none yet: at the centre, on both sides of it along every parameter, and some between; in the
  /// first round also very near the centre.
  void run_design() {
    const Vector r = radius();
    std::vector<Vector> wanted = {centre_};
    for (Eigen::Index j = 0; j < size(); ++j) {
      for (const double side : {-1.0, 1.0}) {
        Vector y = centre_;
        y[j] += side * r[j];
        if (y[j] < lower_[j] || y[j] > upper_[j]) y[j] = centre_[j] - 0.5 * side * r[j];
        wanted.push_back(y.cwiseMax(lower_).cwiseMin(upper_));
      }
    }
    for (Eigen::Index k = 0; k < 1 + size() * (size() - 1) / 2; ++k) wanted.push_back(around(r));
    std::vector<Vector> points;
    const auto near = [&](const Vector& a, const Vector& b) { return largest((a - b).cwiseQuotient(r)) < same_place; };
    for (const Vector& y : wanted) {
      const bool there = std::any_of(trials_.begin(), trials_.end(), [&](const Trial& t) { return near(t.y, y); }) ||
                         std::any_of(points.begin(), points.end(), [&](const Vector& p) { return near(p, y); });
      if (!there) points.push_back(y);
    }
    if (round_ == 1) {
      for (int k = 0; k < noise_runs; ++k) points.push_back(around(Vector::Constant(size(), noise_move)));
    }
    run_all(points);
  }

  [[nodiscard]] std::vector<SurfacePoint> points_around() const {
    std::vector<SurfacePoint> out;
    for (const Trial& t : trials_) {
      if (!t.failure.empty() || largest((t.y - centre_).cwiseQuotient(radius())) > used_within) continue;
      out.push_back({t.y, t.values});
    }
    return out;
  }

  /// Halves the radius; false when it is as small as it may be.
  bool shrink() {
    if ((radius() - floor_).maxCoeff() <= 0.0) return false;
    base_radius_ = std::max(0.5 * base_radius_, smallest_radius);
    return true;
  }

  // ---- Scatter of the runs

  /// The scatter of runs that hardly differ, and from it how far apart runs must be for a slope.
  void measure_noise() {
    std::vector<Vector> rest;
    const Prediction here = predict(*surface_, parameters_of(centre_), true);
    for (const Trial& t : trials_) {
      if (!t.failure.empty() || largest(t.y - centre_) > 1.01 * noise_move) continue;
      rest.push_back(t.values - predict(*surface_, parameters_of(t.y), false).values);
    }
    summary_.noise_runs = rest.size();
    if (rest.size() < 3) return;
    Vector mean = Vector::Zero(value_count());
    for (const Vector& v : rest) mean += v / static_cast<double>(rest.size());
    noise_.setZero();
    for (const Vector& v : rest) noise_ += (v - mean).cwiseAbs2() / static_cast<double>(rest.size() - 1);
    noise_ = noise_.cwiseSqrt();
    const double size_of_values = here.values.norm();
    summary_.scatter = size_of_values > 0.0 ? noise_.norm() / size_of_values : 0.0;
    for (Eigen::Index j = 0; j < size(); ++j) {
      const Coordinate& c = coordinates_[static_cast<std::size_t>(j)];
      const Vector slope = here.jacobian.col(c.place) / c.slope(c.value(centre_[j]));
      const double needed = slope.norm() > 0.0 ? signal_to_noise * noise_.norm() / slope.norm() : 0.0;
      floor_[j] = std::clamp(needed, smallest_radius, largest_radius);
    }
  }

  /// Standard deviations of the values of the fitted scene sets, as the fit sees them.
  [[nodiscard]] Vector deviations(const FitResult& r, const Specification& spec) const {
    Vector out(value_count());
    Eigen::Index at = 0;
    std::size_t next = 0;
    for (const DataSet& set : spec.data) {
      if (set.role != Role::fit) continue;
      const DataSetResult& d = r.data[next++];
      if (!std::holds_alternative<SceneData>(set.test)) continue;
      out.segment(at, d.deviation.size()) = d.deviation;
      at += d.deviation.size();
    }
    return out;
  }

  [[nodiscard]] double noise_level(const FitResult& r) const {
    const Vector d = deviations(r, given_);
    return std::sqrt(noise_.cwiseQuotient(d).squaredNorm() / static_cast<double>(d.size()));
  }

  /// Root mean square of a run less the surface there, in standard deviations of the data.
  [[nodiscard]] double missed_by(const FitResult& r, const Specification& spec, const Trial& t) const {
    const Vector off = t.values - predict(*surface_, parameters_of(t.y), false).values;
    const Vector d = deviations(r, spec);
    return std::sqrt(off.cwiseQuotient(d).squaredNorm() / static_cast<double>(d.size()));
  }

  [[nodiscard]] double weighted_square(const FitResult& r, const Specification& spec, const Vector& values) const {
    const Vector d = deviations(r, spec);
    double sum = 0.0;
    Eigen::Index at = 0;
    for (const std::size_t k : fitted_) {
      const DataSet& set = given_.data[k];
      const Eigen::Index n = set.measured.size();
      sum += set.weight * (values.segment(at, n) - set.measured).cwiseQuotient(d.segment(at, n)).squaredNorm();
      at += n;
    }
    return sum;
  }

  /// Whether the run at a new place is better than that at the centre, with what the other data say there.
  [[nodiscard]] bool lower_cost(const FitResult& r, const Specification& spec, const Trial& t) const {
    const auto at_centre = std::find_if(trials_.begin(), trials_.end(),
                                        [&](const Trial& o) { return o.failure.empty() && o.y == centre_; });
    if (at_centre == trials_.end()) return true;
    const FitProblem problem = make_problem(spec);
    Vector x = r.values;
    double gain = weighted_square(r, spec, at_centre->values) - weighted_square(r, spec, t.values);
    std::size_t next = 0;
    for (const DataSet& set : spec.data) {
      if (set.role != Role::fit) continue;
      const std::size_t k = next++;
      if (std::holds_alternative<SceneData>(set.test)) continue;
      const auto square = [&](const Vector& at) {
        const Prediction p = problem.data[k].forward(at, false);
        if (!p.ok()) return HUGE_VAL;
        return set.weight * (p.values - set.measured).cwiseQuotient(r.data[k].deviation).squaredNorm();
      };
      Vector before = x;
      before.head(size()) = values_at(centre_);
      gain += square(before) - square(x);
    }
    return gain > 0.0;
  }

  [[nodiscard]] bool at_edge(const Vector& y) const {
    const Vector r = radius();
    for (Eigen::Index j = 0; j < size(); ++j) {
      const bool bound = y[j] <= lower_[j] + 1e-6 || y[j] >= upper_[j] - 1e-6;
      if (!bound && std::abs(y[j] - centre_[j]) > 0.98 * r[j]) return true;
    }
    return false;
  }

  /// Whether a step between two minima means nothing: a third of a standard error, or what the scatter of the runs
  /// explains.
  [[nodiscard]] bool settled(const FitResult& found, const Vector& step) {
    const Eigen::MatrixXd scatter = covariance_of_runs(found);
    const Vector x = found.values.head(size());
    for (Eigen::Index j = 0; j < size(); ++j) {
      const double slope = coordinates_[static_cast<std::size_t>(j)].slope(x[j]);
      const double error = slope * found.standard_error[j];
      const double of_runs = slope * std::sqrt(scatter(j, j));
      if (std::abs(step[j]) > std::max({0.3 * error, 2.0 * of_runs, 1e-5})) return false;
    }
    return true;
  }

  // ---- The surface as the forward model

  [[nodiscard]] Specification with_surface(const ResponseSurface& surface, bool within_reach) const {
    Specification out = given_;
    Eigen::Index at = 0;
    for (const std::size_t k : fitted_) {
      ResponseSurface own = surface;
      own.coefficients = surface.coefficients.middleRows(at, out.data[k].measured.size());
      at += out.data[k].measured.size();
      std::get<SceneData>(out.data[k].test).surface = std::make_shared<const ResponseSurface>(std::move(own));
    }
    const Vector r = radius();
    for (Eigen::Index j = 0; j < size(); ++j) {
      const Coordinate& c = coordinates_[static_cast<std::size_t>(j)];
      ParameterSetting& p = out.parameters[static_cast<std::size_t>(c.place)];
      p.value = std::clamp(c.value(centre_[j]), p.lower, p.upper);
      if (!within_reach) continue;
      p.lower = std::max(p.lower, c.value(centre_[j] - r[j]));
      p.upper = std::min(p.upper, c.value(centre_[j] + r[j]));
      p.value = std::clamp(p.value, p.lower, p.upper);
    }
    return out;
  }

  [[nodiscard]] FitOptions local_options() const {
    FitOptions o = options_;
    o.starts = 1;
    o.profiles.clear();
    o.progress = {};
    return o;
  }

  /// Covariance of the parameters that comes from the runs: the surface without each of its runs in turn, one
  /// Gauss-Newton step each (jackknife).
  [[nodiscard]] Eigen::MatrixXd covariance_of_runs(const FitResult& r) const {
    const Eigen::Index unknowns = r.values.size();
    const std::vector<SurfacePoint> points = points_around();
    const std::size_t n = points.size();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(unknowns, unknowns);
    if (static_cast<Eigen::Index>(n) < terms_of(surface_->order, size()) + 1 || !r.covariance.allFinite()) return out;
    std::vector<Vector> steps;
    Vector mean = Vector::Zero(unknowns);
    for (std::size_t k = 0; k < n; ++k) {
      std::vector<SurfacePoint> rest = points;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
      const ResponseSurface without = fit_surface(coordinates_, centre_, radius(), rest, surface_->order);
      steps.push_back(-(r.covariance * (gradient(r, without) - gradient(r, *surface_))));
      mean += steps.back() / static_cast<double>(n);
    }
    const double factor = static_cast<double>(n - 1) / static_cast<double>(n);
    for (const Vector& s : steps) out += factor * (s - mean) * (s - mean).transpose();
    return out;
  }

  /// d cost / d unknown of the fitted scene sets, at r.values.
  [[nodiscard]] Vector gradient(const FitResult& r, const ResponseSurface& surface) const {
    Vector out = Vector::Zero(r.values.size());
    const Prediction x = predict(surface, parameters_with(r.values), true);
    if (!x.ok()) return out;
    const Vector d = deviations(r, given_);
    Eigen::Index at = 0;
    for (const std::size_t k : fitted_) {
      const DataSet& set = given_.data[k];
      const Eigen::Index n = set.measured.size();
      const Vector weighted =
          set.weight * (x.values.segment(at, n) - set.measured).cwiseQuotient(d.segment(at, n).cwiseAbs2());
      for (Eigen::Index j = 0; j < size(); ++j) {
        out[j] += x.jacobian.col(coordinates_[static_cast<std::size_t>(j)].place).segment(at, n).dot(weighted);
      }
      at += n;
    }
    return out;
  }

  // ---- The end

  SceneFit only_predicted() {
    SceneFit out;
    out.specification = given_;
    out.result = fit(make_problem(given_), options_);
    run_predicted(out);
    return out;
  }

  SceneFit no_prediction(const Trial& t) {
    SceneFit out;
    out.specification = given_;
    out.result.status = FitStatus::failed;
    out.result.message = "the scenes give no prediction at the start: " + t.failure;
    const FitProblem problem = make_problem(given_);
    out.result.values.resize(static_cast<Eigen::Index>(problem.parameters.size()));
    for (Eigen::Index k = 0; k < out.result.values.size(); ++k) {
      out.result.values[k] = problem.parameters[static_cast<std::size_t>(k)].start;
    }
    out.summary = summary_;
    out.summary.runs = trials_.size();
    return out;
  }

  /// The fit on the last surface within all bounds, with its statistics; `open` says what is missing.
  SceneFit finish(const Vector& y, const std::string& open) {
    centre_ = y;
    const std::vector<SurfacePoint> points = points_around();
    if (points.size() >= static_cast<std::size_t>(size()) + 2) {
      surface_ = fit_surface(coordinates_, centre_, radius(), points, order_for(points.size(), size()));
    }
    if (!surface_) return no_prediction(trials_.back());
    FitOptions options = options_;
    options.starts = 1;
    SceneFit out;
    out.specification = with_surface(*surface_, false);
    out.result = fit(make_problem(out.specification), options);
    for (std::size_t k = 0; k < given_.parameters.size(); ++k) {  // what the report calls the start
      out.specification.parameters[k].value = given_.parameters[k].value;
    }
    if (out.result.status != FitStatus::failed) add_scatter(out.result);
    if (!open.empty() && out.result.status != FitStatus::failed) {
      out.result.status = FitStatus::not_converged;
      out.result.message = "not converged after " + std::to_string(trials_.size()) + " parameter sets run: " + open +
                           (summary_.failed > 0 ? " (runs that failed: " + summary_.first_failure + ")" : "") +
                           "; start nearer to the solution, fit fewer parameters, or add data";
    }
    run_predicted(out);
    summary_.runs = trials_.size();
    summary_.rounds = std::min(round_, most_rounds);
    summary_.used = points.size();
    for (const Trial& t : trials_) {
      if (t.y == centre_) summary_.warnings.assign(t.warnings.begin(), t.warnings.end());
    }
    say(out.result);
    out.summary = summary_;
    return out;
  }

  /// Standard errors, limits and correlations with what comes from the runs.
  void add_scatter(FitResult& r) {
    summary_.error = Vector::Zero(r.values.size());
    if (r.covariance.rows() != r.values.size()) return;
    const Eigen::MatrixXd scatter = covariance_of_runs(r);
    summary_.error = scatter.diagonal().cwiseMax(0.0).cwiseSqrt();
    for (Eigen::Index k = 0; k < r.values.size(); ++k) {
      const double before = r.standard_error[k];
      if (!(before > 0.0) || !std::isfinite(before)) continue;
      const double factor = std::hypot(before, summary_.error[k]) / before;
      r.standard_error[k] *= factor;
      r.correlated_error[k] = std::hypot(r.correlated_error[k], summary_.error[k]);
      r.lower_limit[k] = r.values[k] + factor * (r.lower_limit[k] - r.values[k]);
      r.upper_limit[k] = r.values[k] + factor * (r.upper_limit[k] - r.values[k]);
    }
    r.covariance += scatter;
    for (Eigen::Index i = 0; i < r.values.size(); ++i) {
      for (Eigen::Index k = 0; k < r.values.size(); ++k) {
        const double product = std::sqrt(r.covariance(i, i) * r.covariance(k, k));
        if (i != k && product > 0.0) r.correlation(i, k) = r.covariance(i, k) / product;
      }
    }
  }

  /// Scenes that are only predicted: one run each, at the best values.
  void run_predicted(SceneFit& out) {
    if (predicted_.empty() || out.result.values.size() < size()) return;
    const auto outcomes = outcomes_of(predicted_, {coordinates_of(out.result.values)});
    for (std::size_t s = 0; s < predicted_.size(); ++s) {
      auto& data = std::get<SceneData>(out.specification.data[predicted_[s]].test);
      const Prediction p = readings_of(data, outcomes[0][s]);
      if (!p.ok()) {
        out.result.warnings.push_back(given_.data[predicted_[s]].name + ": " + p.failure);
        continue;
      }
      data.surface = std::make_shared<const ResponseSurface>(
          fit_surface(coordinates_, centre_, radius(), {{centre_, p.values}}, SurfaceOrder::constant));
    }
  }

  void say(FitResult& r) const {
    if (summary_.failed > 0) {
      r.warnings.push_back(std::to_string(summary_.failed) + " of " + std::to_string(trials_.size()) +
                           " parameter sets gave no prediction; the first: " + summary_.first_failure);
    }
    for (Eigen::Index j = 0; j < std::min(size(), summary_.error.size()); ++j) {
      const double rest = std::sqrt(std::max(0.0, std::pow(r.standard_error[j], 2) - std::pow(summary_.error[j], 2)));
      if (!(summary_.error[j] > rest) || rest == 0.0) continue;
      const auto& p = parameter_info[static_cast<std::size_t>(coordinates_[static_cast<std::size_t>(j)].place)];
      r.warnings.push_back("the standard error of " + std::string(p.name) + " comes from the scatter of the runs (" +
                           shown_value(summary_.error[j], p.unit, 2) + ") more than from the data (" +
                           shown_value(rest, p.unit, 2) + "): a finer spacing or a slower test may lessen it");
    }
    for (const std::string& w : summary_.warnings) r.warnings.push_back("the run at the best values: " + w);
  }

  const Specification& given_;
  const FitOptions& options_;
  const RunScenes& run_;
  std::mt19937_64 generator_;
  std::vector<Coordinate> coordinates_;
  Vector lower_, upper_, centre_;  ///< y
  Vector floor_;                   ///< least radius, by the scatter of the runs
  Vector noise_;                   ///< its standard deviation in each value
  double base_radius_ = first_radius;
  std::vector<std::size_t> fitted_, predicted_;  ///< scene sets by role
  std::vector<Trial> trials_;
  std::optional<ResponseSurface> surface_;
  SceneFitSummary summary_;
  int round_ = 0;
};

}  // namespace

bool has_scenes(const Specification& spec) {
  return std::any_of(spec.data.begin(), spec.data.end(),
                     [](const DataSet& d) { return std::holds_alternative<SceneData>(d.test); });
}

SceneFit fit_with_runs(const Specification& spec, const FitOptions& options, const RunScenes& run) {
  return RunFit(spec, options, run).go();
}

}  // namespace fpz::calibration::detail
