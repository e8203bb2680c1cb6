#include "crack_bands.hpp"

#include <algorithm>
#include <cmath>

#include "chunks.hpp"
#include "fpz/coupling.hpp"
#include "fpz/energy.hpp"

namespace fpz::sph::detail {

namespace {

// The window, in sizes of the particle: whole up to `inner` across the crack, nothing beyond `outer`; along it a cubic
// B-spline, whose values at points that are a size apart sum up to one wherever they lie.
constexpr double inner = 1.5;
constexpr double outer = 2.5;
constexpr double window_width = inner + outer;
constexpr double window_length = 2.0;  // half of it

/// Opening strain, in units of sigma_t0/E, below which the H of the arrangement counts more than the rows that open:
/// what the rock bears elastically says nothing about a crack.
constexpr double first_strain = 1.0;
/// H, in sizes of the particle; and the longest, in lengths beyond which mode I snaps back under strain control: half
/// of it leaves room for other modes.
constexpr double shortest = 0.5;
constexpr double longest = 5.0;
constexpr double longest_of_snap_back = 0.4;
double across(double s) { return std::clamp((outer - s) / (outer - inner), 0.0, 1.0); }

double along(double t) {
  if (t >= 2.0) return 0.0;
  const double rest = 2.0 - t;
  return t < 1.0 ? 2.0 / 3.0 - t * t + 0.5 * t * t * t : rest * rest * rest / 6.0;
}

}  // namespace

template <int Dim>
struct CrackBands<Dim>::Plane {
  Vec<double, Dim> normal, tangent;
  Vec<double, Dim> direction;  ///< of the jump, in that frame
  double jump = 0.0;           ///< its size, m

  explicit Plane(const State<double, Dim>& point)
      : normal(point.frame.row(0).transpose()),
        tangent(point.frame.row(1).transpose()),
        direction(point.crack.jump),
        jump(point.crack.jump.norm()) {
    if (jump > 0.0) direction /= jump;
  }
};

template <int Dim>
void CrackBands<Dim>::find_opened(std::size_t i) {
  const Particles<Dim>& p = run_.particles;
  const Tensor<double, Dim> elastic = elastic_strain<Dim>(run_.materials.bulk(i), p.point[i].stress);
  for (std::size_t c = 0; c < run_.components; ++c) opened_[c][i] = p.strain[c][i] - elastic[static_cast<int>(c)];
}

template <int Dim>
double CrackBands<Dim>::strain_along(const Plane& plane, std::size_t j) const {
  const double xx = opened_[0][j], yy = opened_[1][j], xy = opened_[2][j];
  const Vec<double, Dim> on_plane(xx * plane.normal[0] + xy * plane.normal[1],
                                  xy * plane.normal[0] + yy * plane.normal[1]);
  const double strain =
      plane.direction[0] * plane.normal.dot(on_plane) + 2.0 * plane.direction[1] * plane.tangent.dot(on_plane);
  return std::max(0.0, strain);
}

template <int Dim>
typename CrackBands<Dim>::Window CrackBands<Dim>::window_around(std::size_t i) const {
  const Particles<Dim>& p = run_.particles;
  Window window;
  window.frame = p.point[i].frame;
  const Vec<double, Dim> normal = window.frame.row(0).transpose(), tangent = window.frame.row(1).transpose();
  const double size = std::sqrt(p.volume[i]);
  const auto add = [&](std::size_t j) {
    const Vec<double, Dim> r(p.start[0][j] - p.start[0][i], p.start[1][j] - p.start[1][i]);
    const double weight = across(std::abs(normal.dot(r)) / size) * along(std::abs(tangent.dot(r)) / size) * p.volume[j];
    if (weight == 0.0) return;
    window.all += weight;
    window.parts.push_back({j, weight});
  };
  add(i);
  for (const int j : lists_[i]) add(static_cast<std::size_t>(j));
  return window;
}

template <int Dim>
double CrackBands<Dim>::opening_around(const Plane& plane, std::size_t i) const {
  const Particles<Dim>& p = run_.particles;
  const Window& window = windows_[window_of_[i]];
  double sum = 0.0;
  for (const auto& part : window.parts) {
    if (p.kind[part.particle] == kind::cracked) sum += part.weight * strain_along(plane, part.particle);
  }
  return window_width * std::sqrt(p.volume[i]) * sum / window.all;
}

template <int Dim>
void CrackBands<Dim>::begin(std::size_t i) {
  const Particles<Dim>& p = run_.particles;
  const double stable = longest_of_snap_back * run_.materials.longest_stable(i);
  at_first_[i] = p.length[i];
  longest_[i] = std::max(at_first_[i], std::min(longest * std::sqrt(p.volume[i]), stable));
}

template <int Dim>
bool CrackBands<Dim>::shorten(std::size_t i) {
  if (at_first_[i] == 0.0 || run_.particles.length[i] <= at_first_[i]) return false;
  longest_[i] = at_first_[i];
  change_length(i, at_first_[i]);
  return true;
}

template <int Dim>
double CrackBands<Dim>::length_of(std::size_t i) const {
  const Particles<Dim>& p = run_.particles;
  const Plane plane(p.point[i]);
  if (!(plane.jump > 0.0) || p.point[i].crack.integrity < least_integrity) return p.length[i];
  const double size = std::sqrt(p.volume[i]);
  const double at_first = at_first_[i];
  const Parameters& m = run_.materials.parameters(i);
  const double floor = first_strain * m.tensile_strength / m.young_modulus;
  const double opening = opening_around(plane, i) + at_first * floor;
  const double length = opening / (strain_along(plane, i) + floor) * (opening / (plane.jump + at_first * floor));
  return std::clamp(length, shortest * size, longest_[i]);
}

/// Keeps stress and jump. What the zone stores is per area of crack: the difference that another area makes goes to the
/// numerical losses.
template <int Dim>
void CrackBands<Dim>::change_length(std::size_t i, double length) {
  Particles<Dim>& p = run_.particles;
  if (length == p.length[i]) return;
  State<double, Dim>& point = p.point[i];
  const Material<double> m = run_.materials.material(i, p.length[i]);
  const Tensor<double, Dim> bulk = bulk_strain<double, Dim>(m, point);
  const double scale = p.length[i] / length;
  run_.ledger.viscous[i / lanes] += p.volume[i] / p.length[i] * free_energy(m.law, point.crack) * (1.0 - scale);
  for (std::size_t c = 0; c < run_.components; ++c) {
    const auto k = static_cast<int>(c);
    const double change = (point.strain[k] - bulk[k]) * (scale - 1.0);
    point.strain[k] += change;
    shift_[c][i] += change;
  }
  p.length[i] = length;
}

template <int Dim>
void CrackBands<Dim>::forget(std::size_t i, const Tensor<double, Dim>& change) {
  for (std::size_t c = 0; c < run_.components; ++c) shift_[c][i] += change[static_cast<int>(c)];
  at_first_[i] = 0.0;
}

template <int Dim>
void CrackBands<Dim>::follow() {
  const Particles<Dim>& p = run_.particles;
  if (run_.cracked.empty()) return;
  if (lists_.empty()) {
    const auto volumes = p.volume.begin() + static_cast<std::ptrdiff_t>(p.count);
    const double largest = std::sqrt(*std::max_element(p.volume.begin(), volumes));
    lists_ = find_neighbours<Dim>(run_.team, p.start, p.count, std::hypot(outer, window_length) * largest);
    separate<Dim>(lists_, run_.setup.arrangement.cuts, p.start);
    run_.keep_apart(lists_);
  }
  for (const std::size_t i : run_.cracked) {
    if (window_of_[i] != no_window) continue;
    window_of_[i] = windows_.size();
    windows_.emplace_back();
  }
  run_.for_cracked([this](std::size_t i) {
    find_opened(i);
    Window& window = windows_[window_of_[i]];
    if (window.parts.empty() || window.frame != run_.particles.point[i].frame) window = window_around(i);
  });
  run_.for_cracked([this](std::size_t i) {
    if (at_first_[i] == 0.0) begin(i);
    wanted_[i] = length_of(i);
  });
  // One after the other: the energy that a change takes is booked by blocks.
  for (const std::size_t i : run_.cracked) change_length(i, wanted_[i]);
}

template <int Dim>
Tensor<double, Dim> CrackBands<Dim>::shift(std::size_t i) const {
  Tensor<double, Dim> s;
  for (std::size_t c = 0; c < run_.components; ++c) s[static_cast<int>(c)] = shift_[c][i];
  return s;
}

template class CrackBands<2>;

}  // namespace fpz::sph::detail
