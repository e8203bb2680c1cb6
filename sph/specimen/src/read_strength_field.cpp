// Random strength.
#include <limits>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {

void read_strength_field(const InputReader& r, const Place& place, Scene& scene) {
  constexpr std::array<std::string_view, 3> keys = {"weibull_modulus", "correlation_length", "seed"};
  if (!r.object(place, "\"weibull_modulus\" and \"correlation_length\"")) return;
  r.known_keys(place, keys);
  StrengthField field;
  with_required(r, place, "weibull_modulus", [&](const Place& p) {
    field.weibull_modulus = r.number_between(p, 1.0, 1000.0, true).value_or(field.weibull_modulus);
  });
  with_required(r, place, "correlation_length",
                [&](const Place& p) { field.correlation_length = r.positive(p).value_or(1.0); });
  with(place, "seed", [&](const Place& p) {
    if (const auto seed = r.integer(p, 0, std::numeric_limits<int>::max())) {
      field.seed = static_cast<std::uint64_t>(*seed);
    }
  });
  scene.strength_field = field;
}

}  // namespace fpz::specimen::detail
