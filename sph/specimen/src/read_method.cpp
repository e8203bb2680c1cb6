// The choices of the particle method; names and defaults are those of sph::Options.
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 18> keys = {
    "configuration", "momentum",   "kernel",          "smoothing_ratio",     "courant",
    "rve_length",    "integrator", "viscosity_alpha", "viscosity_beta",      "artificial_stress",
    "skin",          "damping",    "mass_scale",      "zero_energy_control", "release_integrity",
    "gravity",       "threads",    "instruction_set"};
constexpr std::array<std::string_view, 2> configurations = {"reference", "updated"};
constexpr std::array<std::string_view, 2> momenta = {"adjoint", "paper"};
constexpr std::array<std::string_view, 2> kernels = {"cubic_spline", "wendland_c2"};
constexpr std::array<std::string_view, 2> lengths = {"spacing", "band"};
constexpr std::array<std::string_view, 3> methods = {"accurate", "implicit", "paper"};
constexpr std::array<std::string_view, 4> sets = {"best", "baseline", "avx2", "avx512"};

sph::RveLength read_length(const InputReader& r, const Place& p) {
  sph::RveLength length;
  if (p.value().is(JsonValue::Kind::number)) {
    length.rule = sph::RveLength::Rule::number;
    length.value = r.positive(p).value_or(1.0);
  } else if (p.value().is(JsonValue::Kind::string)) {
    if (const auto k = choice(r, p, lengths))
      length.rule = *k == 0 ? sph::RveLength::Rule::spacing : sph::RveLength::Rule::band;
  } else {
    r.problem(p, "expected \"spacing\", \"band\" or a number of metres, found " + p.value().description());
  }
  return length;
}

}  // namespace

void read_method(const InputReader& r, const Place& place, sph::Options<2>& o) {
  if (!r.object(place, "choices of the method")) return;
  r.known_keys(place, keys);
  const auto choose = [&](std::string_view key, std::span<const std::string_view> valid, auto& member) {
    with(place, key, [&](const Place& p) {
      if (const auto k = choice(r, p, valid)) member = static_cast<std::remove_reference_t<decltype(member)>>(*k);
    });
  };
  const auto number = [&](std::string_view key, double& member, double low, double high) {
    with(place, key, [&](const Place& p) { member = r.number_between(p, low, high, true).value_or(member); });
  };
  choose("configuration", configurations, o.configuration);
  choose("momentum", momenta, o.momentum);
  choose("kernel", kernels, o.kernel);
  choose("instruction_set", sets, o.instruction_set);
  with(place, "integrator", [&](const Place& p) {
    if (const auto k = choice(r, p, methods)) o.method = *from_word<Method>(std::string(methods[*k]));
  });
  with(place, "rve_length", [&](const Place& p) { o.rve_length = read_length(r, p); });
  number("smoothing_ratio", o.smoothing_ratio, 0.8, 3.0);
  number("courant", o.courant, 1e-3, 2.0);
  number("viscosity_alpha", o.viscosity_alpha, 0.0, 100.0);
  number("viscosity_beta", o.viscosity_beta, 0.0, 100.0);
  number("artificial_stress", o.artificial_stress, 0.0, 10.0);
  number("skin", o.skin, 0.0, 10.0);
  number("zero_energy_control", o.zero_energy_control, 0.0, 100.0);
  number("damping", o.damping, 0.0, 0.99);
  number("mass_scale", o.mass_scale, 1.0, 1e12);
  number("release_integrity", o.release_integrity, 0.0, 0.99);
  with(place, "gravity", [&](const Place& p) {
    if (const auto g = point(r, p)) o.gravity = *g;
  });
  with(place, "threads", [&](const Place& p) { o.threads = r.integer(p, 0, 4096).value_or(0); });
}

}  // namespace fpz::specimen::detail
