#include <cmath>
#include <limits>

#include "alternatives.hpp"
#include "studies.hpp"

namespace fpz::bench {
namespace {

using Update = std::function<Report(const State2&, const Tensor<double, 2>&, State2&)>;

constexpr const char* rodas = "RODAS 4(3)";
constexpr const char* dormand_prince = "Dormand-Prince 5(4)";
constexpr const char* extrapolated = "extrapolated Euler";

Update update_of(const Material<double>& m, const std::string& method, double tolerance) {
  Options o = options_of(Method::accurate, tolerance);
  o.max_substeps = 300000;
  if (method == rodas) return update_with(m, o, integrate_stepping<Rodas43>);
  if (method == dormand_prince) return update_with(m, o, integrate_stepping<DormandPrince54>);
  return update_with(m, o, integrate_extrapolated);
}

/// All methods, every stage as one update, over a range of tolerances.
std::vector<AlternativeRun> contest(const Case<2>& c, const std::vector<Checkpoint>& reference) {
  const std::vector<int> counts(c.path.legs.size(), 1);
  std::vector<AlternativeRun> runs;
  std::vector<Update> updates;
  for (const char* method : {rodas, dormand_prince, extrapolated}) {
    for (int k = 4; k <= 18; ++k) {
      const double tolerance = std::pow(10.0, -0.5 * k);
      if (method == extrapolated && k > 13) continue;  // second order: too slow to go on
      const Update update = update_of(c.material, method, tolerance);
      runs.push_back({method, tolerance, walk(c, counts, reference, update), 0.0});
      updates.push_back(update);
    }
  }
  std::vector<std::function<void()>> jobs;
  std::vector<AlternativeRun*> of;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].error.ok()) continue;
    jobs.push_back([&c, &counts, &update = updates[i]] { keep(run_path(c, counts, update)); });
    of.push_back(&runs[i]);
  }
  const std::vector<double> seconds = time_interleaved(jobs, 0.1);
  for (std::size_t i = 0; i < of.size(); ++i) of[i]->seconds = seconds[i];
  return runs;
}

std::vector<Checkpoint> end_points(const Case<2>& c, double tolerance) {
  std::vector<Checkpoint> points;
  const auto update = library_update<2>(c.material, options_of(Method::accurate, tolerance));
  State2 s;
  for (const Tensor<double, 2>& leg : c.path.legs) {
    if (!update(s, leg, s).ok()) throw std::runtime_error("end_points: " + c.path.name);
    Checkpoint p;
    p.stress = test::to_matrix3<2>(s.stress);
    p.stress(2, 2) = stress_zz(c.material, s);
    p.damage = damage(s);
    points.push_back(p);
  }
  return points;
}

}  // namespace

AlternativeStudy study_alternatives() {
  AlternativeStudy study;
  const Case<2> ordinary = four_stage_case();
  study.ordinary = contest(ordinary, follow_reference(ordinary, std::vector<int>(4, 1)));

  // The independent reference is explicit itself and would take hours here: tight runs of the library replace it.
  const auto without_reference = [&](const Case<2>& c) {
    const std::vector<Checkpoint> reference = end_points(c, 1e-11);
    const std::vector<Checkpoint> check = end_points(c, 1e-10);
    for (std::size_t i = 0; i < check.size(); ++i) {
      const double stress =
          (check[i].stress - reference[i].stress).cwiseAbs().maxCoeff() / c.path.parameters.tensile_strength;
      study.stiff_reference_check =
          std::max({study.stiff_reference_check, stress, std::abs(check[i].damage - reference[i].damage)});
    }
    return contest(c, reference);
  };
  test::Path<2> path = test::four_stage();
  path.name = "four_stage_stiff";
  path.parameters.normal_stiffness *= 1e6;
  path.parameters.shear_stiffness *= 1e6;
  study.stiff = without_reference(Case<2>(path, "Four stages, Kn and Ks 1e6 times larger", true));
  path.name = "four_stage_separated";
  path.legs.push_back(test::strain2(2e-2, 0, 1e-1));
  study.separated = without_reference(Case<2>(path, "The same, on to separation", true));

  // The same solves in both sets of unknowns.
  const Material<double> m = johnstone<2>();
  std::vector<ReturnInput> inputs;
  for (const State2& s : yielding_points<2>(m)) inputs.push_back(return_input(m, s, mixed_loading<2>(paper_increment)));
  const Zone zone(m.law, m.series);
  double sa = 0.0;
  double za = 0.0;
  for (const ReturnInput& in : inputs) {
    sa += solve_return_sa(zone, in.start, in.entry, in.tolerance).iterations;
    za += detail::solve_return(zone, in.start, in.entry, in.tolerance).iterations;
  }
  study.sa_iterations = sa / point_count;
  study.za_iterations = za / point_count;
  double last = 0.0;
  const auto solves = [&](const auto& solve, double link) {
    return [&inputs, &last, solve, link] {
      for (const ReturnInput& in : inputs) {
        const detail::ReturnSolution r = solve(in, in.start.normal + link * last);
        keep(r);
        last = r.s;
      }
    };
  };
  const auto in_sa = [&](const ReturnInput& in, double qn) {
    return solve_return_sa(zone, {qn, in.start.shear, in.start.integrity}, in.entry, in.tolerance);
  };
  const auto in_za = [&](const ReturnInput& in, double qn) {
    return detail::solve_return(zone, detail::ReturnStart<double>{qn, in.start.shear, in.start.integrity}, in.entry,
                                in.tolerance);
  };
  // 1e-40 m per Pa changes no digit of q.
  const std::vector<double> seconds =
      time_interleaved({solves(in_sa, 0.0), solves(in_za, 0.0), solves(in_sa, 1e-40), solves(in_za, 1e-40)}, 0.5);
  study.sa_over_za = seconds[0] / seconds[1];
  study.sa_over_za_waiting = seconds[2] / seconds[3];
  return study;
}

double seconds_at_error(const std::vector<AlternativeRun>& runs, const std::string& method, double error) {
  const AlternativeRun* above = nullptr;
  for (const AlternativeRun& r : runs) {
    if (r.method != method || !r.error.ok()) continue;
    if (r.error.worst() <= error) {
      if (above == nullptr || r.error.worst() <= 0.0) return r.seconds;
      const double x = std::log(above->error.worst() / error) / std::log(above->error.worst() / r.error.worst());
      return std::exp((1.0 - x) * std::log(above->seconds) + x * std::log(r.seconds));
    }
    above = &r;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace fpz::bench
