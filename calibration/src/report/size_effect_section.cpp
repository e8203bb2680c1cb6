#include "size_effect_section.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "display.hpp"

namespace fpz::calibration::detail {
namespace {

std::string energy(double value, double error = NAN) {
  return digits(value) + (std::isnan(error) ? "" : " ± " + digits(error, 2)) + " N/m";
}

std::string length(double value, double error) {
  const Display d = display("m", value);
  return digits(value / d.factor) + " ± " + digits(error / d.factor, 2) + ' ' + pretty_unit(d.unit);
}

/// What each specimen would be taken for by linear elastic fracture mechanics.
void apparent_toughness(std::ostringstream& out, const DataSet& set, const SizeEffect& e) {
  const auto show = [](double k) { return shown_value(k, "Pa.sqrt(m)"); };
  out << "Linear elastic fracture mechanics reads an apparent toughness K_Q = P k/(t √D) from each largest load. The "
         "cohesive model has the toughness √(E' G_I) = "
      << show(e.toughness)
      << "; the last column is the error of taking K_Q, as the model has it at this size, for that.\n\n"
         "| value | D | k | K_Q, measured | K_Q, cohesive model | K_Q of the model over its toughness |\n"
         "| --- | --- | --- | --- | --- | --- |\n";
  std::set<std::string> sources;
  for (std::size_t k = 0; k < e.points.size(); ++k) {
    const SizeEffectPoint& p = e.points[k];
    sources.insert(p.geometry.source);
    out << "| " << set.labels[k] << " | " << shown_value(p.size, "m") << " | " << digits(p.geometry.k) << " | "
        << show(p.toughness) << " | " << show(p.model_toughness) << " | "
        << percent(p.model_toughness / e.toughness - 1.0, 3) << " |\n";
  }
  out << "\nk is from:";
  for (const std::string& s : sources) out << (s == *sources.begin() ? " " : "; ") << s;
  out << ".\n";
}

void law_row(std::ostringstream& out, const std::string& of, const SizeEffectLaw& law, bool errors) {
  out << "| " << of << " | ";
  if (!law.ok()) {
    out << "- | - | " << law.failure << " |\n";
    return;
  }
  out << energy(law.energy, errors ? law.energy_error : NAN) << " | "
      << (errors ? length(law.length, law.length_error) : shown_value(law.length, "m")) << " | |\n";
}

}  // namespace

std::string size_effect_section(const DataSet& set, const SizeEffect& e) {
  constexpr double recommended_range = 4.0;
  std::ostringstream out;
  out << "\n#### Size effect\n\n";
  apparent_toughness(out, set, e);
  out << "\nBazant's size-effect law (type 2), P/(t D) = √(E' G_f/(g' c_f + g D)):\n\n"
         "| | G_f | c_f | |\n| --- | --- | --- | --- |\n";
  law_row(out, "the law through the measured loads", e.law, true);
  law_row(out, "the law through those of the cohesive model", e.of_model, false);
  out << "| initial energy of the cohesive model, under the first tangent of its softening | "
      << energy(e.initial_energy) << " | | " << digits(e.initial_energy / e.total_energy, 3)
      << " of the total |\n| total energy of the cohesive model, G_I = sigma_t0 delta0 | " << energy(e.total_energy)
      << " | | |\n\nThe two G are not one quantity. The law extrapolates from specimens whose process zone is not "
         "complete at the peak, and so comes out near the initial energy; the total energy is what a crack costs that "
         "runs with a complete zone. The standard errors do not hold an error of E.\n";
  const double range = e.brittleness_high / e.brittleness_low;
  if (range < recommended_range) {
    out << "\nThe sizes D g/g' span a factor of " << digits(range, 3)
        << " only; RILEM TC 89-FMT asks for 4 at least. G_f then depends on small errors of the loads.\n";
  }
  return std::move(out).str();
}

}  // namespace fpz::calibration::detail
