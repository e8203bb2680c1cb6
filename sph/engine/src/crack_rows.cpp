#include "crack_rows.hpp"

#include <algorithm>
#include <cmath>

#include "across_crack.hpp"
#include "crack_bands.hpp"
#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {
constexpr double grown = 0.995;       // integrity over that of the last time, below which a row is straightened again
constexpr double most_lean = 0.6;     // 0.53 at a straight surface of a lattice
constexpr double narrow_from = 0.02;  // damage
}  // namespace

template <int Dim>
void CrackRows<Dim>::write(std::vector<std::size_t>& changed) {
  sort_unique(changed);
  for (const std::size_t i : changed) rows_.rewrite(i);
  stability_.keep(changed);
}

/// Beyond the first row, a particle whose neighbours reach across a crack would have to hold its opening: by moving
/// the first row past the crack's face, with stresses up to the strength, which bridge the crack and tear it open
/// beside where it is.
template <int Dim>
void CrackRows<Dim>::narrow() {
  const Particles<Dim>& p = run_.particles;
  std::vector<std::size_t> changed;
  for (const std::size_t i : run_.cracked) {
    if (damage(p.point[i].crack) < narrow_from || !rows_.narrow(i)) continue;
    changed.push_back(i);
    for (const int j : rows_.neighbours(i)) changed.push_back(static_cast<std::size_t>(j));
  }
  write(changed);
}

/// Mean angle, rad, by which the uncracked neighbours on the row's own side of the crack have turned.
template <int Dim>
double CrackRows<Dim>::rotation_beside(std::size_t i) const {
  const Particles<Dim>& p = run_.particles;
  double sum = 0.0, count = 0.0;
  for (const int neighbour : rows_.neighbours(i)) {
    const auto j = static_cast<std::size_t>(neighbour);
    if (p.kind[j] == kind::cracked || !rows_.is_near(i, j)) continue;
    sum += run_.stretch(j).sine;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// A jump d gives a row the gradient d (x) g, g being the sum of the bonds' vectors beyond the crack: the direction of
/// g is that in which the gradient, less the elastic one and the rotation beside the crack, is largest. It counts as
/// far as one direction stands out and the gradient is more than the rock bears elastically.
template <int Dim>
double CrackRows<Dim>::lean_of(std::size_t i, const Full& correction) const {
  const Particles<Dim>& p = run_.particles;
  const Full raw = rows_.sum(i, [&](std::size_t j) {
    return Vec<double, Dim>((p.position[0][j] - p.position[0][i]) - (p.start[0][j] - p.start[0][i]),
                            (p.position[1][j] - p.position[1][i]) - (p.start[1][j] - p.start[1][i]));
  });
  const Tensor<double, Dim> elastic = elastic_strain<Dim>(run_.materials.bulk(i), p.stress_of(i));
  Full g = product(raw, correction);
  const double turn = rotation_beside(i);
  g = {g.xx - elastic[0], g.xy - elastic[2] + turn, g.yx - elastic[2] - turn, g.yy - elastic[1]};
  const Symmetric square = gram(g);
  const double mean = 0.5 * (square.xx + square.yy), half = 0.5 * (square.xx - square.yy);
  const double radius = std::hypot(half, square.xy);
  const double largest = std::sqrt(mean + radius), other = std::sqrt(std::max(0.0, mean - radius));
  const Parameters& m = run_.materials.parameters(i);
  const double borne =
      std::max(m.tensile_strength / m.young_modulus,
               std::sqrt(elastic[0] * elastic[0] + elastic[1] * elastic[1] + 2.0 * elastic[2] * elastic[2]));
  if (!(largest > borne) || !(largest > 2.0 * other)) return 0.0;
  const double angle = 0.5 * std::atan2(square.xy, half);
  const Vec<double, Dim> direction = p.point[i].frame * Vec<double, Dim>(std::cos(angle), std::sin(angle));
  if (std::abs(direction[1]) > std::abs(direction[0])) return 0.0;
  const double counts = (1.0 - 2.0 * other / largest) * (1.0 - borne / largest);
  return counts * std::clamp(direction[1] / direction[0], -most_lean, most_lean);
}

template <int Dim>
bool CrackRows<Dim>::straighten(std::size_t i) {
  const Particles<Dim>& p = run_.particles;
  const double integrity = p.point[i].crack.integrity;
  // Only while the crack grows: a row that followed the vibrations of a crack would feed them.
  if (integrity < CrackBands<Dim>::least_integrity || integrity > grown * straightened_[i]) return false;
  straightened_[i] = integrity;
  const Full correction = rows_.correction(i);
  rows_.set_lean(i, lean_of(i, correction), correction);
  return true;
}

template <int Dim>
void CrackRows<Dim>::forget(std::size_t i) {
  straightened_[i] = 1.0;
  if (rows_.lean(i) != 0.0) rows_.set_lean(i, 0.0, rows_.correction(i));
}

template <int Dim>
std::vector<int> CrackRows<Dim>::released_by(std::size_t i) const {
  std::vector<int> cut;
  for (const int j : rows_.neighbours(i)) {
    if (is_across_crack(run_.particles, i, static_cast<std::size_t>(j))) cut.push_back(j);
  }
  return cut;
}

template <int Dim>
ReleasedBond<Dim> CrackRows<Dim>::face_of_bond(std::size_t i, std::size_t j) const {
  const Particles<Dim>& p = run_.particles;
  const Vec<double, Dim> r(p.start[0][j] - p.start[0][i], p.start[1][j] - p.start[1][i]);
  Vec<double, Dim> n = p.point[i].frame.row(0).transpose();
  if (n.dot(r) < 0.0) n = -n;
  const Tensor<double, Dim> s = p.stress_of(i);
  return {i, j, n, s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + 2.0 * s[2] * n[0] * n[1] < 0.0};
}

template <int Dim>
void CrackRows<Dim>::release(std::vector<ReleasedBond<Dim>>& cut) {
  const Particles<Dim>& p = run_.particles;
  std::vector<std::size_t> changed;
  for (const std::size_t i : run_.cracked) {
    if (p.point[i].crack.integrity >= run_.setup.options.release_integrity) continue;
    for (const int j : released_by(i)) {
      cut.push_back(face_of_bond(i, static_cast<std::size_t>(j)));
      rows_.cut(i, j);
      changed.push_back(i);
      changed.push_back(static_cast<std::size_t>(j));
    }
  }
  for (const std::size_t i : changed) {
    // The bonds that are left see less of the crack, or none of it.
    if (p.point[i].crack.integrity < run_.setup.options.release_integrity) rows_.forget_lean(i);
  }
  write(changed);
}

template class CrackRows<2>;

}  // namespace fpz::sph::detail
