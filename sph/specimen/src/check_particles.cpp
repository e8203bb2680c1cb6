#include "check_particles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check_scene.hpp"
#include "fpz/sph/kernel.hpp"
#include "point_grid.hpp"

namespace fpz::specimen::detail {
namespace {

using Arrangement = sph::Arrangement<2>;

constexpr std::size_t no_particle = std::numeric_limits<std::size_t>::max();

/// Of one particle: the nearest other one, who interacts with it, and what the kernel says about volumes around it.
struct Surroundings {
  std::size_t nearest = no_particle;
  double distance = std::numeric_limits<double>::infinity();  ///< m, to the nearest
  int neighbours = 0;
  bool touches_specimen = false;  ///< a neighbour is of the specimen
  double filled = 0.0;            ///< sum of V_j W_ij, itself included: 1 inside of a body
};

std::vector<Surroundings> surroundings_of(const Scene& scene, const Arrangement& a) {
  const double h = scene.options.smoothing_ratio * a.spacing, reach = sph::kernel_support * h;
  const PointGrid grid(a.position, reach);
  const double scale = sph::kernel_norm<2>(scene.options.kernel, h);
  std::vector<Surroundings> all(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    Surroundings& s = all[i];
    grid.near(a.position[i], reach, [&](std::size_t j) {
      const double r = (a.position[j] - a.position[i]).norm();
      s.filled += a.volume[j] * scale * sph::kernel_shape(scene.options.kernel, r / h);
      if (j == i) return;
      if (r < s.distance) s.distance = r, s.nearest = j;
      if (share_of_bond(a.cuts, a.position[i], a.position[j], a.spacing) <= 0.0) return;
      ++s.neighbours;
      s.touches_specimen = s.touches_specimen || a.group[j] == Arrangement::specimen;
    });
  }
  return all;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median distance of a hundred particles from their nearest neighbours, however far they are, m.
double usual_distance(const Arrangement& a) {
  const std::size_t stride = std::max<std::size_t>(1, a.size() / 100);
  std::vector<double> distances;
  for (std::size_t i = 0; i < a.size(); i += stride) {
    double square = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (j != i) square = std::min(square, (a.position[j] - a.position[i]).squaredNorm());
    }
    distances.push_back(std::sqrt(square));
  }
  return median(std::move(distances));
}

/// Where a message about particles of a scene begins: the key that they come from.
class Report {
 public:
  Report(const Scene& scene, const Arrangement& a) : scene_(scene), a_(a) {}

  [[nodiscard]] std::string origin() const {
    if (!scene_.particles) return "";
    return "arrangement.file: " + io::in_quotes(scene_.particles->file.string()) + ": ";
  }
  [[nodiscard]] std::string who(std::size_t i) const {
    return "particle " + std::to_string(i) + " at " + brief(a_.position[i]) + owner(i);
  }
  void problem(const std::string& text) { found.problems.push_back(origin() + text); }
  void warn(const std::string& text) { found.warnings.push_back(scene_.file + ": " + origin() + text); }

  ParticleFindings found;

 private:
  [[nodiscard]] std::string owner(std::size_t i) const {
    if (a_.group[i] == Arrangement::specimen) return "";
    return " of boundary " + io::in_quotes(scene_.boundaries[static_cast<std::size_t>(a_.group[i])].name);
  }

  const Scene& scene_;
  const Arrangement& a_;
};

/// "; coordinates are about a thousand times the spacing: millimetres?"
std::string likely_scale(double ratio) {
  for (const auto& [factor, unit] : {std::pair{1e3, "mm"}, std::pair{1e2, "cm"}, std::pair{1e6, "um"}}) {
    const std::string times = std::to_string(std::lround(factor)) + " times ";
    if (std::abs(ratio / factor - 1.0) < 0.5) {
      return "; coordinates are about " + times + "the spacing: they are probably in " + unit +
             ", and must be in m as \"spacing\"";
    }
    if (std::abs(ratio * factor - 1.0) < 0.5) {
      return "; the spacing is about " + times + "the distances: it is probably in " + unit + ", and must be in m";
    }
  }
  return "";
}

/// The smoothing length is a multiple of the spacing: what is farther apart does not interact.
bool distances_fit(Report& report, const Arrangement& a) {
  constexpr double low = 0.4, high = 1.6, usual_low = 0.6, usual_high = 1.25;
  const double typical = usual_distance(a), ratio = typical / a.spacing;
  const std::string text = "particles are " + brief(typical) + " m from their nearest neighbours, \"spacing\" is " +
                           brief(a.spacing) + ": must be about the same" + likely_scale(ratio);
  if (ratio < low || ratio > high) {
    report.problem(text);
    return false;
  }
  if (ratio < usual_low || ratio > usual_high) report.warn(text);
  return true;
}

void check_coincidence(Report& report, const Arrangement& a, const std::vector<Surroundings>& all) {
  constexpr double same = 0.1;  // spacings
  std::size_t count = 0, first = no_particle;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].distance >= same * a.spacing) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  report.problem(std::to_string(count) + " particles lie on others: " + report.who(first) + " is " +
                 brief(all[first].distance) + " m from " + report.who(all[first].nearest) +
                 "; must be about \"spacing\" = " + brief(a.spacing) + " apart");
}

void check_loneliness(Report& report, const std::vector<Surroundings>& all, double reach) {
  std::size_t count = 0, first = no_particle;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].neighbours > 0) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return;
  report.problem(std::to_string(count) + " particles have no neighbours: " + report.who(first) +
                 " is the first; must have others within " + brief(reach) + " m, the support of the kernel");
}

void check_contact(Report& report, const Scene& scene, const Arrangement& a, const std::vector<Surroundings>& all,
                   double reach) {
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    const std::optional<Platen>& platen = scene.boundaries[b].platen;
    if (platen && platen->friction) continue;  // it stands on the surface, without bonds
    bool is_there = false, touches = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a.group[i] != static_cast<int>(b)) continue;
      is_there = true, touches = touches || all[i].touches_specimen;
    }
    if (!is_there || touches) continue;
    report.problem("boundaries[" + std::to_string(b) + "] = " + io::in_quotes(scene.boundaries[b].name) +
                   " touches nothing: none of its particles is within " + brief(reach) + " m of one of the specimen");
  }
}

/// Volumes are areas of cells: those around a place inside add up to what the kernel covers.
void check_volumes(Report& report, const Scene& scene, const Arrangement& a, const std::vector<Surroundings>& all) {
  constexpr double low = 0.6, high = 1.35;
  std::vector<double> filled;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.group[i] != Arrangement::specimen) continue;
    filled.push_back(all[i].filled);
    sum += a.volume[i];
  }
  if (filled.empty()) return report.problem("no particle is of the specimen (group -1)");
  const double usual = median(filled);
  if (usual < low || usual > high) {
    std::string text = "volumes are " + brief(usual) +
                       " times the area that the distances of the particles leave them; "
                       "must be the area of the cell of each, m^2, about spacing^2 = " +
                       brief(a.spacing * a.spacing);
    if (std::abs(usual / scene.thickness - 1.0) < 0.3) text += "; they were probably multiplied by the thickness";
    if (std::abs(usual * 1e-6 - 1.0) < 0.3) text += "; they are probably in mm^2";
    return report.problem(text);
  }
  constexpr double crowded = 1.6;
  const auto many = std::count_if(all.begin(), all.end(), [](const Surroundings& s) { return s.filled > crowded; });
  if (many > 0) {
    const auto first = std::find_if(all.begin(), all.end(), [](const Surroundings& s) { return s.filled > crowded; });
    report.warn("around " + std::to_string(many) +
                " particles volumes exceed the room that their distances leave them: " +
                report.who(static_cast<std::size_t>(first - all.begin())) + " is the first");
  }
  constexpr double same = 0.05;
  const double whole = scene.has_shape ? area(scene.body) : sum;
  if (std::abs(sum / whole - 1.0) > same) {
    report.warn("the volumes of the specimen sum to " + brief(sum) + " m^2, \"shape\" less holes and slots has " +
                brief(whole));
  }
}

void check_sites(Report& report, const Scene& scene, const Arrangement& a) {
  constexpr double far = 2.0;  // spacings
  const auto check = [&](const std::string& gauge, const Site& site) {
    if (!site.group.empty() || site.box) return;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a.group[i] == Arrangement::specimen) nearest = std::min(nearest, (a.position[i] - site.centre).norm());
    }
    if (nearest <= far * a.spacing) return;
    report.problem("gauges." + gauge + ": its point " + brief(site.centre) + " is " + brief(nearest) +
                   " m from the nearest particle; must be within two spacings (" + brief(far * a.spacing) + " m)");
  };
  for (const auto& [name, gauge] : scene.gauges) {
    if (const auto* d = std::get_if<DisplacementGauge>(&gauge)) {
      check(name, d->of);
      for (const Site& s : d->relative_to) check(name, s);
    }
    if (const Site* s = site_of(gauge)) check(name, *s);
  }
}

}  // namespace

ParticleFindings check_particles(const Scene& scene, const Arrangement& a) {
  Report report(scene, a);
  if (scene.particles && !distances_fit(report, a)) return report.found;
  const double reach = sph::kernel_support * scene.options.smoothing_ratio * a.spacing;
  const std::vector<Surroundings> all = surroundings_of(scene, a);
  check_coincidence(report, a, all);
  check_loneliness(report, all, reach);
  check_contact(report, scene, a, all, reach);
  if (!scene.particles) return report.found;
  check_volumes(report, scene, a, all);
  check_sites(report, scene, a);
  return report.found;
}

}  // namespace fpz::specimen::detail
