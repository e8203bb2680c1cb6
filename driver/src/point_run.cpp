#include "point_run.hpp"

#include <chrono>
#include <numbers>
#include <sstream>
#include <vector>

#include "fpz/energy.hpp"
#include "fpz/onset.hpp"
#include "out_of_plane.hpp"
#include "stage_control.hpp"

namespace fpz::driver {
namespace {

template <int Dim>
class PointRun {
 public:
  using Point = State<double, Dim>;
  using Strain = Tensor<double, Dim>;

  PointRun(const Test& test, Observer observer, StepHook<Dim> hook, std::vector<TracedStep<Dim>>* trace)
      : test_(test),
        material_(make_material(test.parameters, test.setting)),
        observer_(std::move(observer)),
        hook_(std::move(hook)),
        trace_(trace) {}

  [[nodiscard]] Result run() {
    const auto started = std::chrono::steady_clock::now();
    record(0, 0, 0.0, 0, "ok");
    for (stage_ = 1; stage_ <= static_cast<int>(test_.stages.size()) && result_.ok(); ++stage_) run_stage();
    summarise();
    judge_stored_energy();
    const std::string unseen = warning_out_of_plane(test_, result_);
    if (!unseen.empty()) result_.warnings.push_back(unseen);
    result_.summary.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(result_);
  }

  [[nodiscard]] const Material<double>& material() const { return material_; }

 private:
  /// Everything that a rejected step must put back.
  struct Snapshot {
    Point point;
    Strain rate = Strain::Zero();  ///< last d(strain)/ds of mixed control
    double s = 0.0;                ///< fraction of the stage
    double work = 0.0;
    double fracture_work = 0.0;
    std::optional<Onset> onset;
    std::vector<TracedStep<Dim>> steps;  ///< since the last row; only with a trace
  };

  static constexpr int most_halvings = 20;
  static constexpr double smallest_automatic_step = 1e-7;
  static constexpr double largest_automatic_step = 0.1;

  [[nodiscard]] const Stage& stage() const { return test_.stages[static_cast<std::size_t>(stage_ - 1)]; }
  [[nodiscard]] double time(double s) const { return stage_ - 1 + s; }

  void run_stage() {
    try {
      control_.emplace(material_, test_.options, stage(), now_.point);
    } catch (const InputError& e) {
      throw InputError("test \"" + test_.name + "\", stage " + std::to_string(stage_) + ": " + e.what());
    }
    now_.s = 0.0;
    now_.rate.setZero();
    arm_stops();
    double ds = std::min(1.0 / stage().increments, largest_automatic_step);
    increment_ = 0;
    while (now_.s < 1.0 && result_.ok()) {
      ++increment_;
      iterations_ = 0;
      const Snapshot begin = now_;
      const double target = next_target(ds);
      if (!advance(target)) return fail();
      if (stage().automatic && !small_enough(begin, target, ds)) {
        now_ = begin;
        --increment_;
        continue;
      }
      const bool stopped = stop_early(begin);
      record(stage_, increment_, time(now_.s), iterations_, "ok");
      if (stopped) break;
    }
  }

  [[nodiscard]] double next_target(double ds) const {
    if (!stage().automatic)
      return increment_ >= stage().increments ? 1.0 : static_cast<double>(increment_) / stage().increments;
    return now_.s + ds > 1.0 - 1e-9 ? 1.0 : now_.s + ds;
  }

  /// Takes the point to fraction `target` of the stage, in halves where a step fails. On failure now_ is the last good
  /// state.
  [[nodiscard]] bool advance(double target) {
    const double whole = target - now_.s;
    double ds = whole;
    int halvings = 0;
    int good = 0;
    while (now_.s < target) {
      const double next = now_.s + ds >= target - 1e-12 * whole ? target : now_.s + ds;
      if (single_step(next)) {
        if (++good >= 2 && halvings > 0) {
          ds *= 2.0;
          --halvings;
          good = 0;
        }
        continue;
      }
      good = 0;
      if (++halvings > most_halvings || status_ == Status::no_plastic_flow || status_ == Status::invalid_input)
        return false;
      ++result_.summary.counts.halvings;
      ds = 0.5 * (next - now_.s);
    }
    return true;
  }

  [[nodiscard]] bool single_step(double target) {
    Point end;
    Strain rate = now_.rate;
    const Step step = control_->step(now_.point, now_.s, target, rate, end);
    result_.summary.counts.updates += step.updates;
    result_.summary.counts.iterations += step.iterations;
    result_.summary.counts.substeps += step.substeps;
    iterations_ += static_cast<int>(step.iterations);
    if (!step.report.ok()) {
      status_ = step.report.status;
      return false;
    }
    if (hook_ && !control_->jump_controlled()) hook_(now_.point, Strain(end.strain - now_.point.strain), time(target));
    account(end, step.report.onset, target);
    if (trace_) now_.steps.push_back({stage_ - 1, now_.s, target, now_.point, end});
    now_.point = end;
    now_.rate = rate;
    now_.s = target;
    return true;
  }

  /// Adds the work of a step, split at the onset of the fracture, where the stress path has its corner.
  void account(const Point& end, bool onset, double target) {
    Point middle = now_.point;
    if (onset) {
      middle = onset_state(end);
      const double share = control_->jump_controlled() ? 0.0 : fraction_of(middle, end);
      note_onset(middle, end, now_.s + share * (target - now_.s));
      now_.work += trapezoid(now_.point, middle);
    }
    now_.work += trapezoid(middle, end);
    if (!end.cracked) return;
    const auto& a = now_.point.crack;
    const auto& b = end.crack;
    const Vec<double, Dim> begin_traction = onset ? local_traction<double, Dim>(end.frame, middle.stress) : a.traction;
    const Vec<double, Dim> begin_jump = onset ? Vec<double, Dim>(Vec<double, Dim>::Zero()) : a.jump;
    now_.fracture_work += 0.5 * (begin_traction + b.traction).dot(b.jump - begin_jump);
  }

  [[nodiscard]] static double trapezoid(const Point& a, const Point& b) {
    return 0.5 * double_dot<Dim>(a.stress + b.stress, b.strain - a.strain);
  }

  /// The uncracked state at which the fracture appears between now_ and `end`.
  [[nodiscard]] Point onset_state(const Point& end) const {
    Point p = now_.point;
    const Strain way = control_->jump_controlled() ? control_->direction() : Strain(end.strain - p.strain);
    const Strain rate = material_.bulk.template stress<double, Dim>(way);
    // Under jump control the end may lie before the onset.
    const auto x = distance_to_onset<Dim>(material_, p.stress, rate, 1.0, 1e12);
    if (x) go_elastically<Dim>(p, way, rate, *x);
    return p;
  }

  [[nodiscard]] double fraction_of(const Point& middle, const Point& end) const {
    const double whole = (end.strain - now_.point.strain).norm();
    return whole > 0.0 ? (middle.strain - now_.point.strain).norm() / whole : 0.0;
  }

  void note_onset(const Point& at, const Point& end, double s) {
    Onset o;
    o.time = time(s);
    o.strain = full_strain<Dim>(material_, at);
    o.stress = full_stress<Dim>(material_, at);
    for (int k = 0; k < Dim; ++k) o.normal[static_cast<std::size_t>(k)] = end.frame(0, k);
    constexpr double degrees = 180.0 / std::numbers::pi;
    if constexpr (Dim == 2) {
      o.angle_deg = std::atan2(o.normal[1], o.normal[0]) * degrees;
      if (o.angle_deg <= -90.0) o.angle_deg += 180.0;
      if (o.angle_deg > 90.0) o.angle_deg -= 180.0;
    } else {
      o.angle_deg = std::acos(std::min(1.0, std::abs(o.normal[0]))) * degrees;
    }
    now_.onset = o;
  }

  /// Automatic stepping: the largest distance of the stress at half the step from the chord, over sigma_t0, decides; ds
  /// is updated.
  [[nodiscard]] bool small_enough(const Snapshot& begin, double target, double& ds) {
    const Snapshot end = now_;
    const double step = target - begin.s;
    now_ = begin;
    if (!advance(begin.s + 0.5 * step)) {  // the whole step worked: half of it failing is no reason to stop
      now_ = end;
      return true;
    }
    const Strain chord = 0.5 * (begin.point.stress + end.point.stress) - now_.point.stress;
    const double error =
        chord.template lpNorm<Eigen::Infinity>() / material_.law.surface.tensile_strength / stage().step_tolerance;
    now_ = end;
    ds = step * std::clamp(0.9 / std::sqrt(error + 1e-12), 0.2, 3.0);
    ds = std::clamp(ds, smallest_automatic_step, largest_automatic_step);
    return error <= 1.0 || step <= smallest_automatic_step * 1.001;
  }

  // --- stop conditions ---

  [[nodiscard]] double excess(const StopCondition& stop) const {
    return find_column(stop.quantity)->get(row(stage_, increment_, time(now_.s), iterations_, "ok")) - stop.value;
  }
  [[nodiscard]] static double nothing(const StopCondition& stop) { return 1e-9 * std::abs(stop.value); }

  /// A quantity that starts the stage at its stop value has to leave it first.
  void arm_stops() {
    for (const StopCondition& stop : stage().stop) {
      const Column* column = find_column(stop.quantity);
      if (!column || !column->get)
        throw InputError("test \"" + test_.name + "\": no column \"" + stop.quantity + "\" to stop at");
    }
  }

  [[nodiscard]] static bool reached(const StopCondition& stop, double before, double after) {
    if (std::abs(before) <= nothing(stop)) return false;
    return after == 0.0 || (before < 0.0) != (after < 0.0);
  }

  /// Moves now_ back to the first point since `begin` at which a stop condition holds.
  [[nodiscard]] bool stop_early(const Snapshot& begin) {
    bool stopped = false;
    for (const StopCondition& stop : stage().stop) {
      const Snapshot end = now_;
      now_ = begin;
      const double before = excess(stop);
      now_ = end;
      if (!reached(stop, before, excess(stop))) continue;
      stopped = true;
      locate(begin, stop, before);
    }
    return stopped;
  }

  /// Bisection on the size of the increment. now_ is past the crossing on entry and on the crossing, to rounding, on
  /// exit.
  void locate(const Snapshot& begin, const StopCondition& stop, double before) {
    Snapshot good = now_;
    double lo = begin.s;
    double hi = now_.s;
    for (int k = 0; k < 60 && hi - lo > 1e-12 * (good.s - begin.s) && hi - lo > 1e-15; ++k) {
      const double middle = 0.5 * (lo + hi);
      now_ = begin;
      if (!advance(middle)) break;
      const double e = excess(stop);
      if ((e < 0.0) == (before < 0.0) && e != 0.0) {
        lo = middle;
      } else {
        hi = middle;
        good = now_;
      }
      if (std::abs(e) <= 1e-12 * std::abs(stop.value)) break;
    }
    now_ = good;
  }

  // --- rows, failures, summary ---

  [[nodiscard]] Row row(int stage_number, int increment, double at, int iterations, const std::string& status) const {
    const Point& p = now_.point;
    Row r;
    r.stage = stage_number;
    r.increment = increment;
    r.time = at;
    r.strain = full_strain<Dim>(material_, p);
    r.stress = full_stress<Dim>(material_, p);
    r.cracked = p.cracked;
    if (p.cracked) {
      for (int k = 0; k < Dim; ++k) {
        const auto i = static_cast<std::size_t>(k);
        r.normal[i] = p.frame(0, k);
        r.jump[i] = p.crack.jump[k];
        r.traction[i] = p.crack.traction[k];
      }
      r.plastic_normal = p.crack.plastic_jump[0];
      r.plastic_slip = p.crack.slip;
    }
    r.damage = damage(p);
    r.stored = stored_energy(material_, p);
    r.dissipated = dissipated_energy(material_, p);
    r.iterations = iterations;
    r.status = status;
    r.work = now_.work;
    return r;
  }

  void record(int stage_number, int increment, double at, int iterations, const std::string& status) {
    result_.history.push_back(row(stage_number, increment, at, iterations, status));
    if (trace_) {
      trace_->insert(trace_->end(), now_.steps.begin(), now_.steps.end());
      now_.steps.clear();
    }
    if (observer_) observer_({stage_number, static_cast<int>(test_.stages.size()), at, result_.history.back().damage});
  }

  void fail() {
    const bool limit =
        control_->ramps_stress() && status_ != Status::invalid_input && status_ != Status::no_plastic_flow;
    result_.status = limit ? "load_limit" : to_string(status_);
    std::ostringstream text;
    text.precision(6);
    text << "test \"" << test_.name << "\" stopped in stage " << stage_ << ", increment " << increment_ << ", time "
         << time(now_.s) << ": " << explanation(limit);
    result_.message = text.str();
    record(stage_, increment_, time(now_.s), iterations_, result_.status);
  }

  [[nodiscard]] std::string explanation(bool limit) const {
    if (limit) {
      return "the load limit is reached: no equilibrium carries more of the prescribed stress. Use strain control or "
             "jump control to "
             "go past the peak.";
    }
    if (status_ == Status::no_plastic_flow) {
      return "the flow rule has no opening (dilation angle 0) that could relax the tension. Use a dilation angle above "
             "0.";
    }
    if (status_ == Status::invalid_input) return "a strain is not finite.";
    if (control_->jump_controlled())
      return "this direction no longer loads the fracture, so its inelastic displacement cannot grow along it.";
    const bool mixed = !control_->strain_only();
    if (status_ == Status::snap_back || mixed) return snap_back_advice(mixed);
    return "the integrator \"" + std::string(to_string(test_.options.method)) +
           "\" does not converge, even with the increment halved 20 times. Use \"accurate\" or \"implicit\".";
  }

  [[nodiscard]] std::string snap_back_advice(bool mixed) const {
    std::ostringstream text;
    text.precision(6);
    const double h = test_.parameters.rve_length;
    const double kappa = test_.parameters.delta0 / 100.0;
    text << (mixed ? "no solution follows under these controls, most likely for snap-back" : "snap-back")
         << ": the fracture softens faster than the bulk of the volume unloads, and the response is not unique. H = "
         << h << " m here; in mode I the limit under strain control is H < "
         << snap_back_length(test_.parameters, test_.setting)
         << " m, in mixed mode it is lower. Use a smaller H, or jump control in this stage of the path file: "
            "\"jump_control\": "
            "{\"increment\": "
         << kappa << "}.";
    return text.str();
  }

  void summarise() {
    Summary& s = result_.summary;
    for (std::size_t c = 0; c < 6; ++c) {
      for (const Row& r : result_.history) {
        if (r.stress[c] > s.highest[c].value) s.highest[c] = {r.stress[c], r.time};
        if (r.stress[c] < s.lowest[c].value) s.lowest[c] = {r.stress[c], r.time};
      }
    }
    s.onset = now_.onset;
    for (std::size_t c = 0; s.onset && c < 6; ++c) {  // the peak lies between two rows
      if (s.onset->stress[c] > s.highest[c].value) s.highest[c] = {s.onset->stress[c], s.onset->time};
      if (s.onset->stress[c] < s.lowest[c].value) s.lowest[c] = {s.onset->stress[c], s.onset->time};
    }
    s.least_stored = {0.0, 0.0};
    for (const Row& r : result_.history) {
      if (r.stored < s.least_stored.value) s.least_stored = {r.stored, r.time};
    }
    const Row& last = result_.history.back();
    s.damage = last.damage;
    s.stored = last.stored;
    s.dissipated = last.dissipated;
    s.work = last.work;
    const double largest = std::max({std::abs(s.work), std::abs(s.stored), std::abs(s.dissipated)});
    s.energy_balance = largest > 0.0 ? (s.work - s.stored - s.dissipated) / largest : 0.0;
    s.fracture_work_per_area = now_.fracture_work;
    s.fracture_dissipated_per_area = now_.point.cracked ? now_.point.crack.dissipated : 0.0;
  }

  /// Less than nothing cannot be stored: a balance that closes with it is none.
  void judge_stored_energy() {
    constexpr double negligible = 0.01;  // of G
    const Parameters& p = test_.parameters;
    const double fracture_energy = p.tensile_strength * p.delta0;
    const double least = result_.summary.least_stored.value * p.rve_length;
    if (!result_.ok() || least >= -negligible * fracture_energy) return;
    result_.status = "negative_energy";
    std::ostringstream text;
    text.precision(4);
    text
        << "test \"" << test_.name << "\": the stored energy falls to " << least << " J per m^2 of crack at time "
        << result_.summary.least_stored.time << ", where the fracture energy is " << fracture_energy
        << ": an error of the model, which gives back energy that nobody put in. The springs of the published zone are "
           "preloaded at onset. Use \"cohesive_zone\": \"consistent\", or stiffer springs.";
    result_.message = text.str();
  }

  const Test& test_;
  const Material<double> material_;
  Observer observer_;
  StepHook<Dim> hook_;
  std::vector<TracedStep<Dim>>* trace_;
  Result result_;
  Snapshot now_;
  std::optional<StageControl<Dim>> control_;
  Status status_ = Status::ok;
  int stage_ = 0;
  int increment_ = 0;
  int iterations_ = 0;
};

}  // namespace

template <int Dim>
Result run_point(const Test& test, const Observer& observer, const StepHook<Dim>& hook,
                 std::vector<TracedStep<Dim>>* trace) {
  return PointRun<Dim>(test, observer, hook, trace).run();
}

template Result run_point<2>(const Test&, const Observer&, const StepHook<2>&, std::vector<TracedStep<2>>*);
template Result run_point<3>(const Test&, const Observer&, const StepHook<3>&, std::vector<TracedStep<3>>*);

}  // namespace fpz::driver
