// The traction at which a zone starts to yield when only the direction of its loading is known.
#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "fpz/material.hpp"

namespace fpz::calibration {

/// Size of the shear traction on a yield surface (eq 48), Pa, from `radius` = c - sigma_n tan(phi) and its apex:
/// sqrt(radius^2 - apex^2), without cancellation.
template <class T>
[[nodiscard]] T surface_shear(const T& radius, const T& apex) {
  using std::sqrt;
  return sqrt((radius - apex) * (radius + apex));
}

/// The point of the undamaged yield surface (eq 48) met by the traction ray towards (normal, shear) = K.direction, that
/// is by a zone loaded along its springs; with `angle_deg` by the ray at that angle from the normal instead. Local
/// frame, Pa; nothing where the ray stays inside the surface (compression within friction).
template <class T>
[[nodiscard]] std::optional<Vec<T, 2>> onset_traction(const CohesiveLaw<T>& law, const Vec<double, 2>& direction,
                                                      std::optional<double> angle_deg = {}) {
  using std::sqrt;
  Vec<T, 2> ray;
  if (angle_deg) {
    ray[0] = T(std::cos(*angle_deg * degree));
    ray[1] = T(*angle_deg == 0.0 ? 0.0 : std::sin(*angle_deg * degree));
  } else {
    ray[0] = law.kn * direction[0];
    ray[1] = law.ks * direction[1];
    const T size = sqrt(ray[0] * ray[0] + ray[1] * ray[1]);
    ray /= size;
  }
  // sqrt(l^2 ray_s^2 + A^2) = c0 - l ray_n tan(phi), squared; the root on the physical branch, without cancellation.
  const T free = (law.surface.cohesion - law.surface.apex) * (law.surface.cohesion + law.surface.apex);
  const T b = law.surface.cohesion * ray[0] * law.surface.tan_phi;
  const T pull = ray[0] * law.surface.tan_phi * law.surface.apex;
  const T below = b + sqrt(ray[1] * ray[1] * free + pull * pull);
  if (!(value(below) > 0.0) ||
      (value(ray[0]) < 0.0 &&
       value(ray[1] * ray[1]) <= value(ray[0] * ray[0] * law.surface.tan_phi * law.surface.tan_phi)))
    return std::nullopt;
  return Vec<T, 2>(ray * T(free / below));
}

}  // namespace fpz::calibration
