// Data sets of the kind "fracture_energy": one measured energy or toughness.
#include <cmath>

#include "data_set_reader.hpp"
#include "set_keys.hpp"

namespace fpz::calibration::detail {
namespace {

FractureEnergyTest read_test(const SetContext& s, const Place& set) {
  const Context& c = s.c;
  FractureEnergyTest test;
  if (const JsonValue* v = c.reader.required(set, "mode")) {
    test.path = read_word<FracturePath>(c, Place(set, *v), "mode").value_or(test.path);
  }
  if (const JsonValue* v = set.value().find("end_opening")) test.end = read_judged(c, Place(set, *v), typical::opening);
  if (const JsonValue* v = set.value().find("onset_angle_deg")) {
    test.onset_angle_deg = c.reader.number_between(Place(set, *v), 0.0, 179.9, true);
  }
  const JsonValue* angle = set.value().find("angle_deg");
  if (test.path == FracturePath::direction) {
    if (angle == nullptr) c.problem(set, "missing key \"angle_deg\": the direction of the jump from the normal");
    if (angle != nullptr) test.angle_deg = c.reader.number_between(Place(set, *angle), 0.0, 90.0, true).value_or(0.0);
  } else if (angle != nullptr) {
    c.problem(Place(set, *angle), "goes with \"mode\": \"direction\"");
  }
  if (const JsonValue* v = set.value().find("normal_traction")) {
    const Place at(set, *v);
    if (test.path != FracturePath::shear_at_normal_traction) c.problem(at, "goes with \"mode\": \"II\"");
    if (const auto x = read_written(c, at, Quantity::stress)) test.normal_traction = x->si;
  }
  return test;
}

/// K of the energy G that the test takes, K^2 = G E (plane stress) or G E/(1 - nu^2).
Prediction toughness_of(Prediction energy, const Parameters& p, Setting setting, bool derivatives) {
  if (!energy.ok()) return energy;
  const double g = energy.values[0];
  const double k = toughness_from_energy(g, p.young_modulus, p.poisson_ratio, setting);
  energy.values[0] = k;
  if (!derivatives) return energy;
  energy.jacobian *= 0.5 * k / g;
  energy.jacobian(0, static_cast<int>(Parameter::young_modulus)) += 0.5 * k / p.young_modulus;
  if (setting != Setting::plane_stress) {
    const double nu = p.poisson_ratio;
    energy.jacobian(0, static_cast<int>(Parameter::poisson_ratio)) += k * nu / (1.0 - nu * nu);
  }
  return energy;
}

}  // namespace

void read_fracture_energy(const SetContext& s, const Place& set, DataSet& out) {
  const Context& c = s.c;
  c.reader.known_keys(set, set_keys({"mode", "angle_deg", "energy", "toughness", "end_opening", "normal_traction",
                                     "onset_angle_deg", "deviation"}));
  const FractureEnergyTest test = read_test(s, set);
  const JsonValue* energy = set.value().find("energy");
  const JsonValue* toughness = set.value().find("toughness");
  if ((energy == nullptr) == (toughness == nullptr)) {
    c.problem(set, "give either \"energy\" (J/m2) or \"toughness\" (Pa.sqrt(m))");
    return;
  }
  const bool is_energy = energy != nullptr;
  const Quantity quantity = is_energy ? Quantity::energy_per_area : Quantity::toughness;
  const auto value = read_judged(c, Place(set, is_energy ? *energy : *toughness),
                                 is_energy ? typical::fracture_energy : typical::toughness);
  if (!value) return;
  if (!is_energy && s.setting == Setting::three_d) {
    c.problem(Place(set, *toughness), "a toughness converts to an energy in plane strain or plane stress only");
    return;
  }
  out.measured = Eigen::VectorXd::Constant(1, *value);
  out.abscissa = Eigen::VectorXd::Constant(1, 1.0);
  out.labels = {is_energy ? "G" : "K"};
  out.value_axis = readable_axis(is_energy ? "Fracture energy" : "Toughness", quantity, *value);
  if (auto d = read_deviation(c, set, quantity, out.measured)) {
    out.deviation = std::move(d->values);
    out.deviation_known = d->known;
    out.deviation_words = std::move(d->words);
    if (!d->known) c.problem(set, "a single value needs a known deviation");
  }
  out.test = FractureEnergyData{test, !is_energy, *value, s.setting};
}

}  // namespace fpz::calibration::detail

namespace fpz::calibration {

Prediction predict(const FractureEnergyData& data, const Parameters& p, const Eigen::VectorXd& /*nuisance*/,
                   bool derivatives) {
  Prediction x = predict(data.test, p, derivatives);
  return data.is_toughness ? detail::toughness_of(std::move(x), p, data.setting, derivatives) : x;
}

double measured_energy(const FractureEnergyData& data, const Parameters& p) {
  if (!data.is_toughness) return data.measured;
  return energy_from_toughness(data.measured, p.young_modulus, p.poisson_ratio, data.setting);
}

}  // namespace fpz::calibration
