#include "zero_energy_control.hpp"

#include <algorithm>
#include <cmath>

#include "chunks.hpp"
#include "plane.hpp"

namespace fpz::sph::detail {

namespace {

/// Smoothing length of the kernel that weights the bonds, in spacings: it ends at two spacings. On a square lattice the
/// eight nearest neighbours with the weights 4 and 1 of the isotropic Laplacian.
constexpr double control_smoothing = 1.0;

/// A direction without bonds (moment below this part of the larger one) has no gradient, and needs none.
constexpr double no_moment = 1e-9;

}  // namespace

template <int Dim>
ZeroEnergyControl<Dim>::ZeroEnergyControl(RunData<Dim>& run, double strength) : run_(run), strength_(strength) {
  const Particles<Dim>& p = run.particles;
  lists_ = find_neighbours<Dim>(run.team, p.start, p.count,
                                kernel_support * control_smoothing * run.setup.arrangement.spacing);
  separate<Dim>(lists_, run.setup.arrangement.cuts, p.start);
  run.keep_apart(lists_);
  bonds_ = pack<Dim>(lists_, p.padded(), Beside::a_number);
  fields(*this, Allocate{p.padded()});
  fields(*this, Point<Dim>{run.view});
  AlikeBonds alike(run.setup.arrangement.spacing);
  for (std::size_t i = 0; i < p.count; ++i) write_row(i, alike);
  bonds_.share();
  run.view.control_bonds = bonds_.view();
  run.view.controlled = true;
}

template <int Dim>
void ZeroEnergyControl<Dim>::write_row(std::size_t i, AlikeBonds& alike) {
  const Particles<Dim>& p = run_.particles;
  const double h = control_smoothing * run_.setup.arrangement.spacing;
  const double norm = strength_ * kernel_norm<Dim>(Kernel::cubic_spline, h) / (h * h);
  Symmetric moment = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < lists_[i].size(); ++k) {
    const auto j = static_cast<std::size_t>(lists_[i][k]);
    const Vec<double, Dim> r = alike(Vec<double, Dim>(p.start[0][j] - p.start[0][i], p.start[1][j] - p.start[1][i]));
    const double rx = r[0], ry = r[1];
    const double q = std::sqrt(rx * rx + ry * ry) / h;
    const double modulus = run_.materials.equally_stiff(i, j) ? run_.materials.confined_modulus(i) : 0.0;
    const double stiffness = norm * modulus * (p.volume[i] * p.volume[j]) * kernel_slope(Kernel::cubic_spline, q);
    const std::size_t entry = bonds_.entry(i, k);
    bonds_.beside[entry] = stiffness;
    bonds_.weight[0][entry] = stiffness * rx;
    bonds_.weight[1][entry] = stiffness * ry;
    moment.xx += stiffness * rx * rx;
    moment.yy += stiffness * ry * ry;
    moment.xy += stiffness * rx * ry;
  }
  const Symmetric inverse = inverse_above(moment, no_moment);
  fit_[0][i] = inverse.xx;
  fit_[1][i] = inverse.yy;
  fit_[2][i] = inverse.xy;
}

template <int Dim>
double ZeroEnergyControl<Dim>::share_of(std::size_t i) const {
  const Particles<Dim>& p = run_.particles;
  const Parameters& m = run_.materials.parameters(i);
  const double most = p.length[i] * m.tensile_strength / m.young_modulus;
  return std::max(0.0, 1.0 - damage(p.point[i].crack) * m.delta0 / most);
}

/// A force that is gone at the end of the step has done the work of its beginning for half of the way: so the energy of
/// the middle is what is lost.
template <int Dim>
void ZeroEnergyControl<Dim>::let_go(double step) {
  double& lost = run_.ledger.zero_energy;
  for (const std::size_t i : run_.cracked) {
    if (share_[i] == 0.0) continue;
    const double share = share_of(i);
    if (share >= share_[i]) continue;
    const double left = share / share_[i];
    lost += (1.0 - left) * stored_at(i, 0.5 * step);
    share_[i] = share;
    for (Field& g : gradient_) g[i] *= left;
  }
}

template <int Dim>
void ZeroEnergyControl<Dim>::forget_displacements() {
  for (Field& u : displacement_) std::fill(u.begin(), u.end(), 0.0);
  for (Field& g : gradient_) std::fill(g.begin(), g.end(), 0.0);
}

template <int Dim>
double ZeroEnergyControl<Dim>::stored() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < run_.particles.count; ++i) sum += stored_at(i, 0.0);
  return sum;
}

template <int Dim>
double ZeroEnergyControl<Dim>::alternation() const {
  double most = 0.0;
  for (std::size_t i = 0; i < run_.particles.count; ++i) {
    if (share_[i] < 1.0) continue;
    double stiffness = 0.0;
    for (std::size_t k = 0; k < lists_[i].size(); ++k) stiffness += bonds_.beside[bonds_.entry(i, k)];
    if (stiffness > 0.0) most = std::max(most, 4.0 * stored_at(i, 0.0) / stiffness);
  }
  return std::sqrt(most);
}

template <int Dim>
double ZeroEnergyControl<Dim>::stored_at(std::size_t i, double before) const {
  const Fields<Dim>& u = run_.particles.velocity;
  Full s = {0.0, 0.0, 0.0, 0.0};  // sum k_ij (u_j - u_i) (x) r_ij, and of k_ij |u_j - u_i|^2:
  double whole = 0.0;
  for (std::size_t k = 0; k < lists_[i].size(); ++k) {
    const auto j = static_cast<std::size_t>(lists_[i][k]);
    const std::size_t entry = bonds_.entry(i, k);
    const double ux = (displacement_[0][j] - displacement_[0][i]) - before * (u[0][j] - u[0][i]);
    const double uy = (displacement_[1][j] - displacement_[1][i]) - before * (u[1][j] - u[1][i]);
    s.xx += ux * bonds_.weight[0][entry];
    s.xy += ux * bonds_.weight[1][entry];
    s.yx += uy * bonds_.weight[0][entry];
    s.yy += uy * bonds_.weight[1][entry];
    whole += bonds_.beside[entry] * (ux * ux + uy * uy);
  }
  // What a least-squares fit leaves is the whole less what it explains.
  const Symmetric f = {fit_[0][i], fit_[1][i], fit_[2][i]};
  const double explained = f.xx * (s.xx * s.xx + s.yx * s.yx) + f.yy * (s.xy * s.xy + s.yy * s.yy) +
                           2.0 * f.xy * (s.xx * s.xy + s.yx * s.yy);
  return 0.25 * share_[i] * (whole - explained);
}

template class ZeroEnergyControl<2>;

}  // namespace fpz::sph::detail
