#include <limits>

#include "fpz/cohesive_update.hpp"
#include "studies.hpp"

namespace fpz::bench {

MapStudy study_maps() {
  MapStudy study;
  study.size = 61;
  const Material<double> m = johnstone<2>();
  const Options exact = options_of(Method::accurate, 1e-11);
  const double delta0 = m.law.softening.length();
  const double opening = paper_increment * m.rve_length / delta0;
  study.paper_step = {opening, 10.0 * opening};  // du = 2 H d eps_xy
  for (const Method method : {Method::paper, Method::implicit}) {
    for (const double damage_wanted : {0.0, 0.3, 0.8}) {
      // A point on the surface: cracked in mixed mode, then opened and sheared alike until D is reached.
      const double shear = 0.4e6;
      const double normal = m.law.surface.point(shear * shear).normal;
      CohesiveState<double, 2> begin = cracked_at<double, 2>(m.law, Vec<double, 2>(normal, shear));
      const Vec<double, 2> direction(delta0, delta0);
      double low = 0.0;
      double high = 20.0;
      CohesiveState<double, 2> end = begin;
      for (int k = 0; k < 60 && damage_wanted > 0.0; ++k) {
        const double mid = 0.5 * (low + high);
        if (!cohesive_update(m.law, exact, begin, Vec<double, 2>(direction * mid), end).ok()) {
          throw std::runtime_error("study_maps: no begin state");
        }
        (damage(end) < damage_wanted ? low : high) = mid;
      }
      begin = end;
      ErrorMap map;
      map.method = method;
      map.damage = damage(begin);
      const Options o = options_of(method, 1e-4);
      const auto error = [&](double un, double us) {
        CohesiveState<double, 2> a, b;
        const Vec<double, 2> du(un * delta0, us * delta0);
        if (!cohesive_update(m.law, exact, begin, du, b).ok()) throw std::runtime_error("study_maps: no reference");
        if (!cohesive_update(m.law, o, begin, du, a).ok()) return std::numeric_limits<double>::quiet_NaN();
        return (a.traction - b.traction).lpNorm<Eigen::Infinity>() / m.law.surface.tensile_strength;
      };
      double failed = 0.0;
      double good = 0.0;
      for (int j = 0; j < study.size; ++j) {
        for (int i = 0; i < study.size; ++i) {
          const auto at = [&](int k) {
            return std::pow(10.0, study.low + (study.high - study.low) * k / (study.size - 1));
          };
          const double e = error(at(i), at(j));
          failed += std::isnan(e) ? 1.0 : 0.0;
          good += e <= 1e-2 ? 1.0 : 0.0;
          map.log10_error.push_back(std::log10(std::max(e, 1e-16)));
        }
      }
      const double cells = static_cast<double>(study.size) * study.size;
      map.failed_share = failed / cells;
      map.within_1_percent = good / cells;
      map.at_paper_step = error(study.paper_step[0], study.paper_step[1]);
      study.maps.push_back(map);
    }
  }
  return study;
}

}  // namespace fpz::bench
