#include "bond_rows.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace fpz::sph::detail {

namespace {
/// Sizes of the particle across the crack, up to which a bond of a narrowed row is near: on a lattice along the crack
/// the first row of neighbours is, the second is not.
constexpr double near = 1.5;
/// Part of the moment that every row must keep. On a lattice along the crack 0.78 is left; rows that keep less have
/// corrections, and with them frequencies, that the time step was not made for.
constexpr double kept_moment = 0.7;
/// The inverse of a matrix; singular values s below the least take s/least^2, which is continuous and goes to zero.
Full bounded_inverse(const Full& m, double least) {
  const Eigen::Matrix2d a{{m.xx, m.xy}, {m.yx, m.yy}};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> gram;
  gram.computeDirect(a.transpose() * a);
  const Eigen::Vector2d inverse = gram.eigenvalues().cwiseMax(least * least).cwiseInverse();
  const Eigen::Matrix2d l =
      gram.eigenvectors() * inverse.asDiagonal() * gram.eigenvectors().transpose() * a.transpose();
  return {l(0, 0), l(0, 1), l(1, 0), l(1, 1)};
}
}  // namespace

template <int Dim>
BondRows<Dim>::BondRows(RunData<Dim>& run, NeighbourLists& lists, Bonds<Dim>& bonds)
    : run_(run),
      lists_(lists),
      bonds_(bonds),
      leans_(run.particles.count, 0.0),
      has_lost_(run.particles.count, 0),
      softened_(run.particles.count, 1.0),
      width_(run.particles.count, Width::whole) {
  const Options<Dim>& o = run.setup.options;
  bonds_ = pack<Dim>(lists_, run.particles.padded(), Beside::nothing);
  if (o.gradient == Gradient::consistent && o.momentum == MomentumForm::adjoint) {
    vectors_ = make_bond_vectors(run, lists_);
  }
  write_all();
}

template <int Dim>
Vec<double, Dim> BondRows<Dim>::between(std::size_t i, std::size_t j) const {
  const Fields<Dim>& x = run_.particles.start;
  return {x[0][j] - x[0][i], x[1][j] - x[1][i]};
}

template <int Dim>
bool BondRows<Dim>::is_near(std::size_t i, std::size_t j) const {
  if (width_[i] != Width::narrow) return true;
  const Particles<Dim>& p = run_.particles;
  return std::abs(p.point[i].frame.row(0).dot(between(i, j))) < near * std::sqrt(p.volume[i]);
}

template <int Dim>
Vec<double, Dim> BondRows<Dim>::vector_of(std::size_t i, int j) const {
  const auto k = static_cast<std::size_t>(j);
  if (!is_near(i, k) || !is_near(k, i)) return Vec<double, Dim>::Zero();
  if (vectors_) return (*vectors_)(i, j);
  const Particles<Dim>& p = run_.particles;
  const Vec<double, Dim> from(p.start[0][i], p.start[1][i]), to(p.start[0][k], p.start[1][k]);
  const Vec<double, Dim> r = to - from;
  const Arrangement<Dim>& a = run_.setup.arrangement;
  const double slope = share_of_bond(a.cuts, from, to, a.spacing) * run_.view.slope_norm * (p.volume[i] * p.volume[k]) *
                       kernel_slope(run_.setup.options.kernel, std::sqrt(r[0] * r[0] + r[1] * r[1]) / run_.h);
  return slope * r;
}

template <int Dim>
double BondRows<Dim>::least_moment(std::size_t i) const {
  Full m = {0.0, 0.0, 0.0, 0.0};
  for (const int j : lists_[i]) add_product(m, between(i, static_cast<std::size_t>(j)), vector_of(i, j));
  const Symmetric square = gram(m);
  const double mean = 0.5 * (square.xx + square.yy), radius = std::hypot(0.5 * (square.xx - square.yy), square.xy);
  return std::sqrt(std::max(0.0, mean - radius)) / run_.particles.volume[i];
}

template <int Dim>
bool BondRows<Dim>::narrow(std::size_t i) {
  if (width_[i] != Width::whole) return false;
  width_[i] = Width::narrow;
  const auto keeps = [this](std::size_t k) { return least_moment(k) >= kept_moment; };
  const std::vector<int>& list = lists_[i];
  const bool ok =
      keeps(i) && std::all_of(list.begin(), list.end(), [&](int j) { return keeps(static_cast<std::size_t>(j)); });
  if (!ok) width_[i] = Width::refused;
  return ok;
}

template <int Dim>
void BondRows<Dim>::cut(std::size_t i, int j) {
  const auto k = static_cast<std::size_t>(j);
  std::erase(lists_[i], j);
  std::erase(lists_[k], static_cast<int>(i));
  has_lost_[i] = has_lost_[k] = 1;
}

template <int Dim>
Full BondRows<Dim>::moment(std::size_t i) const {
  return sum(i, [&](std::size_t j) { return between(i, j); });
}

/// The kernel's moment is symmetric; that of other vectors is no longer when some were cut.
template <int Dim>
Full BondRows<Dim>::correction(std::size_t i) const {
  const Full m = moment(i);
  if (has_lost_[i] != 0 || softened_[i] != 1.0) {
    const Full l = bounded_inverse(m, least_whole);
    const double part = softened_[i];
    return {part * l.xx, part * l.xy, part * l.yx, part * l.yy};
  }
  if (!vectors_) return full(correction_of(Symmetric{m.xx, m.yy, m.xy}));
  return correction_of(m);
}

template <int Dim>
void BondRows<Dim>::write_all() {
  for (std::size_t i = 0; i < run_.particles.count; ++i) write(i);
  bonds_.share();
}

/// eq 17, eq 18: the vectors of a row's bonds and their correction L_i.
template <int Dim>
void BondRows<Dim>::write(std::size_t i) {
  const std::vector<int>& list = lists_[i];
  const std::size_t block = i / lanes;
  const auto width = static_cast<std::size_t>(bonds_.column[block + 1] - bonds_.column[block]);
  for (std::size_t k = 0; k < width; ++k) {
    const bool real = k < list.size();
    const Vec<double, Dim> w = real ? vector_of(i, list[k]) : Vec<double, Dim>(Vec<double, Dim>::Zero());
    const std::size_t entry = bonds_.entry(i, k);
    bonds_.neighbour[entry] = real ? list[k] : static_cast<int>(i);
    bonds_.weight[0][entry] = w[0];
    bonds_.weight[1][entry] = w[1];
  }
  bonds_.own(block);
  const Full c = correction(i);
  if (run_.setup.options.momentum == MomentumForm::adjoint) {
    set_correction(i, c);
    return;
  }
  // L_i is on both stresses and on the velocity gradient alike: it goes into the weights of the row.
  for (std::size_t k = 0; k < width; ++k) {
    const std::size_t entry = bonds_.entry(i, k);
    const double wx = bonds_.weight[0][entry];
    const double wy = bonds_.weight[1][entry];
    bonds_.weight[0][entry] = c.xx * wx + c.xy * wy;
    bonds_.weight[1][entry] = c.yx * wx + c.yy * wy;
  }
  set_correction(i, {1.0, 0.0, 0.0, 1.0});
}

template <int Dim>
void BondRows<Dim>::add_half_way(std::size_t i, double part) {
  const auto& t = run_.particles.flux;
  // All places of the row: those of bonds that are cut are still there until it is written.
  const std::size_t block = i / lanes;
  const auto width = static_cast<std::size_t>(bonds_.column[block + 1] - bonds_.column[block]);
  for (std::size_t k = 0; k < width; ++k) {
    const std::size_t entry = bonds_.entry(i, k);
    const double wx = bonds_.weight[0][entry], wy = bonds_.weight[1][entry];
    const Vec<double, Dim> f(part * (t[0][i] * wx + t[1][i] * wy), part * (t[2][i] * wx + t[3][i] * wy));
    half_way_.emplace_back(i, f);
    half_way_.emplace_back(static_cast<std::size_t>(bonds_.neighbour[entry]), -f);
  }
}

template <int Dim>
template <class F>
void BondRows<Dim>::change(std::size_t i, F&& f) {
  add_half_way(i, 0.5);
  f();
  set_flux(i, run_.stress_at(i));
  add_half_way(i, -0.5);
}

template <int Dim>
void BondRows<Dim>::set_flux(std::size_t i, const Symmetric& stress) {
  Particles<Dim>& p = run_.particles;
  const Full l = {p.correction[0][i], p.correction[2][i], p.correction[3][i], p.correction[1][i]};
  const Stretch now = run_.stretch(i);
  const Full t = flux_of(now.cosine, now.sine, work_conjugate(stress, now.strain), l);
  p.flux[0][i] = t.xx;
  p.flux[1][i] = t.xy;
  p.flux[2][i] = t.yx;
  p.flux[3][i] = t.yy;
}

template <int Dim>
void BondRows<Dim>::rewrite(std::size_t i) {
  change(i, [&] { write(i); });
}

template <int Dim>
void BondRows<Dim>::soften(std::size_t i, double part) {
  softened_[i] *= part;
  change(i, [&] { set_correction(i, correction(i)); });
}

template <int Dim>
void BondRows<Dim>::set_lean(std::size_t i, double lean, const Full& correction) {
  leans_[i] = lean;
  set_correction(i, correction);
}

/// L_i (I - lean n (x) t), of stress and strain alike, so that the force stays the derivative of the energy.
template <int Dim>
void BondRows<Dim>::set_correction(std::size_t i, const Full& c) {
  Particles<Dim>& p = run_.particles;
  Full l = c;
  if (leans_[i] != 0.0) {
    const double nx = p.point[i].frame(0, 0), ny = p.point[i].frame(0, 1);
    const double tx = leans_[i] * p.point[i].frame(1, 0), ty = leans_[i] * p.point[i].frame(1, 1);
    const double x = c.xx * nx + c.xy * ny, y = c.yx * nx + c.yy * ny;
    l = {c.xx - x * tx, c.xy - x * ty, c.yx - y * tx, c.yy - y * ty};
  }
  p.correction[0][i] = l.xx;
  p.correction[1][i] = l.yy;
  p.correction[2][i] = l.xy;
  p.correction[3][i] = l.yx;
}

template class BondRows<2>;

}  // namespace fpz::sph::detail
