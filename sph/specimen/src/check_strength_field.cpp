// Random strength against the particles and the body.
#include <cmath>

#include "check_scene.hpp"

namespace fpz::specimen::detail {

void check_strength_field(const SceneCheck& c) {
  constexpr double coarse = 2.0;         // spacings
  constexpr double least_modulus = 3.0;  // of rock and concrete; usual are 5 to 30
  if (!c.scene.strength_field) return;
  const StrengthField& field = *c.scene.strength_field;
  const auto [low, high] = extent(c.scene.body.shape);
  const double size = (high - low).maxCoeff();
  with(c.root, "strength_field", [&](const Place& p) {
    at_member(p, "correlation_length", [&](const Place& length) {
      if (field.correlation_length < coarse * c.scene.spacing) {
        c.warn(length, "less than two spacings (" + brief(coarse * c.scene.spacing) +
                           " m): the strength changes from particle to particle, and results with the spacing");
      }
      if (field.correlation_length > size) {
        c.warn(length, "longer than the body (" + brief(size) +
                           " m): all of it is nearly alike, by chance weak or strong" +
                           likely_length(field.correlation_length, 0.0, size));
      }
    });
    at_member(p, "weibull_modulus", [&](const Place& modulus) {
      if (field.weibull_modulus >= least_modulus) return;
      c.warn(modulus,
             "scatters far more than rock or concrete, which have 5 to 30: a hundredth of the body has less "
             "than " +
                 brief(std::pow(0.01005, 1.0 / field.weibull_modulus)) + " of the usual strength");
    });
  });
}

}  // namespace fpz::specimen::detail
