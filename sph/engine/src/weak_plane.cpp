#include "weak_plane.hpp"

#include <algorithm>

#include "fpz/onset.hpp"

namespace fpz::sph::detail {

namespace {

/// Part x of the way from the traction t to t + way at which F of a surface reaches zero, being negative at t and not
/// at the end. F is convex along the way: Newton from the end goes down to the one crossing.
template <int Dim, class Surface>
double crossing(const Surface& surface, const Vec<double, Dim>& t, const Vec<double, Dim>& way) {
  double x = 1.0;
  for (int k = 0; k < 60; ++k) {
    const Vec<double, Dim> here = t + x * way;
    const double step = surface.value_at(here[0], here.template tail<Dim - 1>().squaredNorm(), 1.0) /
                        surface.template value_rate<double, Dim>(here, way);
    if (!(step > 0.0)) break;
    x = std::max(0.0, x - step);
    if (step <= 1e-15) break;
  }
  return x;
}

}  // namespace

template <int Dim>
std::optional<OpenedPlane<Dim>> opened_weak_plane(const ParticleMaterials<Dim>& materials, std::size_t i,
                                                  const State<double, Dim>& begin,
                                                  const Tensor<double, Dim>& increment) {
  if (begin.cracked || !materials.has_weak_plane(i)) return std::nullopt;
  const Material<double>& zone = materials.weak_material(i);
  const Material<double> material = materials.material(i, 1.0);
  const Mat<double, Dim, Dim> frame = frame_from<double>(materials.weak_normal(i));
  const Tensor<double, Dim> strain = begin.strain + increment;
  const Tensor<double, Dim> end = material.bulk.template stress<double, Dim>(strain);
  const Tensor<double, Dim> change = end - begin.stress;
  const Vec<double, Dim> from = local_traction<double, Dim>(frame, begin.stress);
  const Vec<double, Dim> way = local_traction<double, Dim>(frame, change);
  const auto value = [&](const Vec<double, Dim>& t) {
    return zone.law.surface.value_at(t[0], t.template tail<Dim - 1>().squaredNorm(), 1.0);
  };
  if (!(value(from + way) >= 0.0)) return std::nullopt;
  const double x = value(from) >= 0.0 ? 0.0 : crossing<Dim>(zone.law.surface, from, way);
  const bool material_fails = critical_plane<Dim>(material, end).failure_value >= 0.0;
  if (material_fails && onset_fraction<Dim>(material, begin.stress, end) < x) return std::nullopt;
  OpenedPlane<Dim> opened{begin, Tensor<double, Dim>(increment * (1.0 - x))};
  go_elastically<Dim>(opened.state, increment, change, x);
  opened.state.cracked = true;
  opened.state.frame = frame;
  opened.state.crack = cracked_at<double, Dim>(zone.law, local_traction<double, Dim>(frame, opened.state.stress));
  return opened;
}

template std::optional<OpenedPlane<2>> opened_weak_plane<2>(const ParticleMaterials<2>&, std::size_t,
                                                            const State<double, 2>&, const Tensor<double, 2>&);

}  // namespace fpz::sph::detail
