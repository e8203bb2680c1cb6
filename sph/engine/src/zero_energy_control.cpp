#include "zero_energy_control.hpp"

#include <algorithm>
#include <cmath>

#include "across_crack.hpp"
#include "chunks.hpp"
#include "plane.hpp"
#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {

/// Smoothing length of the kernel that weights the bonds, in spacings: it ends at two spacings. On a square lattice the
/// eight nearest neighbours with the weights 4 and 1 of the isotropic Laplacian.
constexpr double control_smoothing = 1.0;

/// A direction without bonds (moment below this part of the larger one) has no gradient, and needs none.
constexpr double no_moment = 1e-9;

/// Integrity 1 - D of an open crack below which the bonds across it are cut.
constexpr double cut_integrity = 0.15;

/// Cracks that slide keep their bonds: faces under pressure need them.
template <int Dim>
bool is_open(const CohesiveState<double, Dim>& crack) {
  return crack.integrity < cut_integrity && crack.jump[0] > std::abs(crack.jump[1]);
}

}  // namespace

template <int Dim>
ZeroEnergyControl<Dim>::ZeroEnergyControl(RunData<Dim>& run, double strength) : run_(run), strength_(strength) {
  const Particles<Dim>& p = run.particles;
  lists_ = find_neighbours<Dim>(run.team, p.start, p.count,
                                kernel_support * control_smoothing * run.setup.arrangement.spacing);
  separate<Dim>(lists_, run.setup.arrangement.cuts, p.start);
  run.keep_apart(lists_);
  fields(*this, Allocate{p.padded()});
  fields(*this, Point<Dim>{run.view});
  make_bonds();
  run.view.controlled = true;
}

template <int Dim>
void ZeroEnergyControl<Dim>::make_bonds() {
  const Particles<Dim>& p = run_.particles;
  bonds_ = pack<Dim>(lists_, p.padded(), Beside::a_number);
  AlikeBonds alike(run_.setup.arrangement.spacing);
  for (std::size_t i = 0; i < p.count; ++i) write_row(i, alike);
  bonds_.share();
  run_.view.control_bonds = bonds_.view();
}

template <int Dim>
void ZeroEnergyControl<Dim>::write_row(std::size_t i, AlikeBonds& alike) {
  const Particles<Dim>& p = run_.particles;
  const double h = control_smoothing * run_.setup.arrangement.spacing;
  const double norm = strength_ * kernel_norm<Dim>(Kernel::cubic_spline, h) / (h * h);
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
  }
  fit(i);
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
  if (run_.setup.options.release_integrity > 0.0 && run_.steps % release_interval == 0) cut(step);
}

template <int Dim>
auto ZeroEnergyControl<Dim>::bonds_across() const -> std::vector<Bond> {
  std::vector<Bond> bonds;
  for (const std::size_t i : run_.cracked) {
    if (!is_open(run_.particles.point[i].crack)) continue;
    for (std::size_t k = 0; k < lists_[i].size(); ++k) {
      const auto j = static_cast<std::size_t>(lists_[i][k]);
      if (bonds_.beside[bonds_.entry(i, k)] == 0.0 || !is_across_crack(run_.particles, i, j)) continue;
      bonds.push_back({std::min(i, j), std::max(i, j)});
    }
  }
  sort_unique(bonds);
  return bonds;
}

template <int Dim>
void ZeroEnergyControl<Dim>::cut(double step) {
  const std::vector<Bond> bonds = bonds_across();
  std::vector<std::size_t> rows;
  for (const Bond& bond : bonds) rows.insert(rows.end(), bond.begin(), bond.end());
  sort_unique(rows);
  double& lost = run_.ledger.zero_energy;
  for (const std::size_t i : rows) lost += stored_at(i, 0.5 * step);
  for (const Bond& bond : bonds) remove(bond);
  for (const std::size_t i : rows) {
    fit(i);
    write_gradient(i);
    lost -= stored_at(i, 0.5 * step);
  }
  cut_.insert(cut_.end(), bonds.begin(), bonds.end());
}

template <int Dim>
void ZeroEnergyControl<Dim>::remove(const Bond& bond) {
  for (std::size_t end = 0; end < 2; ++end) {
    const std::size_t i = bond[end];
    const auto at = std::lower_bound(lists_[i].begin(), lists_[i].end(), static_cast<int>(bond[1 - end]));
    bonds_.own(i / lanes);
    const std::size_t entry = bonds_.entry(i, static_cast<std::size_t>(at - lists_[i].begin()));
    bonds_.beside[entry] = bonds_.weight[0][entry] = bonds_.weight[1][entry] = 0.0;
  }
}

template <int Dim>
void ZeroEnergyControl<Dim>::fit(std::size_t i) {
  Symmetric moment = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < lists_[i].size(); ++k) {
    const std::size_t entry = bonds_.entry(i, k);
    const double stiffness = bonds_.beside[entry], x = bonds_.weight[0][entry], y = bonds_.weight[1][entry];
    if (stiffness == 0.0) continue;
    moment.xx += x * x / stiffness;
    moment.yy += y * y / stiffness;
    moment.xy += x * y / stiffness;
  }
  const Symmetric inverse = inverse_above(moment, no_moment);
  fit_[0][i] = inverse.xx;
  fit_[1][i] = inverse.yy;
  fit_[2][i] = inverse.xy;
}

template <int Dim>
void ZeroEnergyControl<Dim>::write_gradient(std::size_t i) {
  const Full s = differences(i, 0.0).moment;
  const Symmetric f = {share_[i] * fit_[0][i], share_[i] * fit_[1][i], share_[i] * fit_[2][i]};
  gradient_[0][i] = s.xx * f.xx + s.xy * f.xy;
  gradient_[1][i] = s.xx * f.xy + s.xy * f.yy;
  gradient_[2][i] = s.yx * f.xx + s.yy * f.xy;
  gradient_[3][i] = s.yx * f.xy + s.yy * f.yy;
}

template <int Dim>
void ZeroEnergyControl<Dim>::save(Writer& archive) const {
  archive(cut_);
  fields(*this, Transfer<Writer>{archive});
}

template <int Dim>
void ZeroEnergyControl<Dim>::load(Reader& archive) {
  archive(cut_);
  make_bonds();
  for (const Bond& bond : cut_) {
    const bool known = bond[0] < lists_.size() && bond[1] < lists_.size() &&
                       std::binary_search(lists_[bond[0]].begin(), lists_[bond[0]].end(), static_cast<int>(bond[1]));
    if (!known) throw ArchiveError("it has cut a bond that is none");
    remove(bond);
  }
  fields(*this, Transfer<Reader>{archive});
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
auto ZeroEnergyControl<Dim>::differences(std::size_t i, double before) const -> Differences {
  const Fields<Dim>& v = run_.particles.velocity;
  Differences sum;
  Full& s = sum.moment;
  for (std::size_t k = 0; k < lists_[i].size(); ++k) {
    const auto j = static_cast<std::size_t>(lists_[i][k]);
    const std::size_t entry = bonds_.entry(i, k);
    const double ux = (displacement_[0][j] - displacement_[0][i]) - before * (v[0][j] - v[0][i]);
    const double uy = (displacement_[1][j] - displacement_[1][i]) - before * (v[1][j] - v[1][i]);
    s.xx += ux * bonds_.weight[0][entry];
    s.xy += ux * bonds_.weight[1][entry];
    s.yx += uy * bonds_.weight[0][entry];
    s.yy += uy * bonds_.weight[1][entry];
    sum.square += bonds_.beside[entry] * (ux * ux + uy * uy);
  }
  return sum;
}

template <int Dim>
double ZeroEnergyControl<Dim>::stored_at(std::size_t i, double before) const {
  const Differences sum = differences(i, before);
  const Full& s = sum.moment;
  // What a least-squares fit leaves is the whole less what it explains.
  const Symmetric f = {fit_[0][i], fit_[1][i], fit_[2][i]};
  const double explained = f.xx * (s.xx * s.xx + s.yx * s.yx) + f.yy * (s.xy * s.xy + s.yy * s.yy) +
                           2.0 * f.xy * (s.xx * s.xy + s.yx * s.yy);
  return 0.25 * share_[i] * (sum.square - explained);
}

template class ZeroEnergyControl<2>;

}  // namespace fpz::sph::detail
