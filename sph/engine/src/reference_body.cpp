#include "reference_body.hpp"

#include <algorithm>
#include <cmath>

#include "chunks.hpp"

namespace fpz::sph::detail {

namespace {
// Openings grow slowly; steps between searches for open bonds, and between changes of H:
constexpr long long release_interval = 16;
constexpr long long band_interval = 4;
constexpr double grown = 0.995;    // integrity over that of the last time, below which a row is straightened again
constexpr double most_lean = 0.6;  // of ReferenceBody::leans_: 0.53 at a straight surface of a lattice
}  // namespace

template <int Dim>
ReferenceBody<Dim>::ReferenceBody(RunData<Dim>& run) : Body<Dim>(run) {
  const Particles<Dim>& p = run.particles;
  this->lists_ = find_neighbours<Dim>(p.start, p.count, kernel_support * run.h);
  const Arrangement<Dim>& a = run.setup.arrangement;
  drop_without_share<Dim>(this->lists_, a.cuts, p.start, a.spacing);
  keep_apart(this->lists_, run.piece);
  this->bonds_ = pack<Dim>(this->lists_, p.padded(), false);
  this->builds_ = 1;
  const Options<Dim>& o = run.setup.options;
  if (o.gradient == Gradient::consistent && o.momentum == MomentumForm::adjoint) {
    vectors_ = make_bond_vectors(run, this->lists_);
  }
  leans_.assign(p.count, 0.0);
  straightened_.assign(p.count, 1.0);
  for (std::size_t i = 0; i < p.count; ++i) write_row(i);
  this->point_bonds();
  if (o.rve_length.rule == RveLength::Rule::band) bands_.emplace(run);
}

template <int Dim>
Outcome ReferenceBody<Dim>::advance() {
  const RunData<Dim>& run = this->run_;
  const Outcome outcome = this->strain_with([&run](Index first, Index last) {
    run.passes->drift(run.view, first, last);
    run.passes->gradient_reference(run.view, first, last);
  });
  if (bands_ && run.steps % band_interval == 0) {
    bands_->follow();
    if (run.setup.options.momentum == MomentumForm::adjoint) {
      run.for_chunks([this](Index first, Index last) { straighten(first, last); });
    }
  }
  if (run.setup.options.release_integrity > 0.0 && run.steps % release_interval == 0) release_bonds();
  return outcome;
}

template <int Dim>
void ReferenceBody<Dim>::force(const View<Dim>& view) {
  const auto pass = this->run_.passes->force_reference;
  this->run_.for_chunks([&](Index first, Index last) { pass(view, first, last); });
}

template <int Dim>
Tensor<double, Dim> ReferenceBody<Dim>::strain_increment(std::size_t i, const State<double, Dim>& begin) const {
  Tensor<double, Dim> increment = bands_ ? bands_->shift(i) : Tensor<double, Dim>(Tensor<double, Dim>::Zero());
  for (std::size_t k = 0; k < this->run_.components; ++k) {
    const auto c = static_cast<int>(k);
    increment[c] += this->run_.particles.strain[k][i] - begin.strain[c];
  }
  return increment;
}

template <int Dim>
void ReferenceBody<Dim>::set_flux(std::size_t i, const Symmetric& stress) {
  Particles<Dim>& p = this->run_.particles;
  const Full l = {p.correction[0][i], p.correction[2][i], p.correction[3][i], p.correction[1][i]};
  const Full t = flux_of(p.rotation[0][i], p.rotation[1][i], stress, l);
  p.flux[0][i] = t.xx;
  p.flux[1][i] = t.xy;
  p.flux[2][i] = t.yx;
  p.flux[3][i] = t.yy;
}

template <int Dim>
Vec<double, Dim> ReferenceBody<Dim>::vector_of(std::size_t i, int j) const {
  if (vectors_) return (*vectors_)(i, j);
  const RunData<Dim>& run = this->run_;
  const Particles<Dim>& p = run.particles;
  const auto k = static_cast<std::size_t>(j);
  const Vec<double, Dim> from(p.start[0][i], p.start[1][i]), to(p.start[0][k], p.start[1][k]);
  const Vec<double, Dim> r = to - from;
  const Arrangement<Dim>& a = run.setup.arrangement;
  const double slope = share_of_bond(a.cuts, from, to, a.spacing) * run.view.slope_norm * (p.volume[i] * p.volume[k]) *
                       kernel_slope(run.setup.options.kernel, std::sqrt(r[0] * r[0] + r[1] * r[1]) / run.h);
  return slope * r;
}

/// eq 18. The kernel's moment is symmetric; that of other vectors is no longer when some were cut.
template <int Dim>
Full ReferenceBody<Dim>::correction_of_row(const Full& moment) const {
  if (!vectors_) return full(correction_of(Symmetric{moment.xx, moment.yy, moment.xy}));
  return correction_of(moment);
}

/// eq 17, eq 18: the vectors of a row's bonds and their correction L_i.
template <int Dim>
void ReferenceBody<Dim>::write_row(std::size_t i) {
  RunData<Dim>& run = this->run_;
  Bonds<Dim>& bonds = this->bonds_;
  const std::vector<int>& list = this->lists_[i];
  const std::size_t block = i / lanes;
  const auto width = static_cast<std::size_t>(bonds.column[block + 1] - bonds.column[block]);
  const auto entry = [&](std::size_t k) { return bonds.entry(i, k); };
  for (std::size_t k = 0; k < width; ++k) {
    const bool real = k < list.size();
    const Vec<double, Dim> w = real ? vector_of(i, list[k]) : Vec<double, Dim>(Vec<double, Dim>::Zero());
    bonds.neighbour[entry(k)] = real ? list[k] : static_cast<int>(i);
    bonds.weight[0][entry(k)] = w[0];
    bonds.weight[1][entry(k)] = w[1];
  }
  const Full c = correction_of_row(moment_of_row(i));
  if (run.setup.options.momentum == MomentumForm::adjoint) {
    set_correction(i, c);
    return;
  }
  // L_i is on both stresses and on the velocity gradient alike: it goes into the weights of the row.
  for (std::size_t k = 0; k < width; ++k) {
    const double wx = bonds.weight[0][entry(k)];
    const double wy = bonds.weight[1][entry(k)];
    bonds.weight[0][entry(k)] = c.xx * wx + c.xy * wy;
    bonds.weight[1][entry(k)] = c.yx * wx + c.yy * wy;
  }
  set_correction(i, {1.0, 0.0, 0.0, 1.0});
}

template <int Dim>
template <class Difference>
Full ReferenceBody<Dim>::sum_over_row(std::size_t i, Difference&& difference) const {
  Full sum = {0.0, 0.0, 0.0, 0.0};
  const double inverse = 1.0 / this->run_.particles.volume[i];
  for (std::size_t k = 0; k < this->lists_[i].size(); ++k) {
    const std::size_t entry = this->bonds_.entry(i, k);
    const Vec<double, Dim> d = inverse * difference(static_cast<std::size_t>(this->lists_[i][k]));
    sum.xx += d[0] * this->bonds_.weight[0][entry];
    sum.xy += d[0] * this->bonds_.weight[1][entry];
    sum.yx += d[1] * this->bonds_.weight[0][entry];
    sum.yy += d[1] * this->bonds_.weight[1][entry];
  }
  return sum;
}

template <int Dim>
Full ReferenceBody<Dim>::moment_of_row(std::size_t i) const {
  const Fields<Dim>& x = this->run_.particles.start;
  return sum_over_row(i, [&](std::size_t j) { return Vec<double, Dim>(x[0][j] - x[0][i], x[1][j] - x[1][i]); });
}

/// Derivatives along a crack are taken in the direction t - lean n: L_i (I - lean n (x) t). Of stress and strain alike,
/// so that the force stays the derivative of the energy.
template <int Dim>
void ReferenceBody<Dim>::set_correction(std::size_t i, const Full& c) {
  Particles<Dim>& p = this->run_.particles;
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

/// Mean angle, rad, by which the uncracked neighbours have turned.
template <int Dim>
double ReferenceBody<Dim>::rotation_beside(std::size_t i) const {
  const Particles<Dim>& p = this->run_.particles;
  double sum = 0.0, count = 0.0;
  for (const int neighbour : this->lists_[i]) {
    const auto j = static_cast<std::size_t>(neighbour);
    if (p.kind[j] == kind::cracked) continue;
    sum += p.rotation[1][j];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

/// A jump d gives a row the gradient d (x) g, g being the sum of the bonds' vectors beyond the crack: the direction of
/// g is that in which the gradient, less the elastic one and the rotation beside the crack, is largest. It counts as
/// far as one direction stands out and the gradient is more than the rock bears elastically.
template <int Dim>
double ReferenceBody<Dim>::lean_of(std::size_t i, const Full& correction) const {
  const RunData<Dim>& run = this->run_;
  const Particles<Dim>& p = run.particles;
  const Full raw = sum_over_row(i, [&](std::size_t j) {
    return Vec<double, Dim>((p.position[0][j] - p.position[0][i]) - (p.start[0][j] - p.start[0][i]),
                            (p.position[1][j] - p.position[1][i]) - (p.start[1][j] - p.start[1][i]));
  });
  const Tensor<double, Dim> elastic = elastic_strain<Dim>(run.material.bulk, p.stress_of(i));
  Full g = product(raw, correction);
  const double turn = rotation_beside(i);
  g = {g.xx - elastic[0], g.xy - elastic[2] + turn, g.yx - elastic[2] - turn, g.yy - elastic[1]};
  const Symmetric square = {g.xx * g.xx + g.yx * g.yx, g.xy * g.xy + g.yy * g.yy, g.xx * g.xy + g.yx * g.yy};
  const double mean = 0.5 * (square.xx + square.yy), half = 0.5 * (square.xx - square.yy);
  const double radius = std::hypot(half, square.xy);
  const double largest = std::sqrt(mean + radius), other = std::sqrt(std::max(0.0, mean - radius));
  const double borne =
      std::max(run.setup.parameters.tensile_strength / run.setup.parameters.young_modulus,
               std::sqrt(elastic[0] * elastic[0] + elastic[1] * elastic[1] + 2.0 * elastic[2] * elastic[2]));
  if (!(largest > borne) || !(largest > 2.0 * other)) return 0.0;
  const double angle = 0.5 * std::atan2(square.xy, half);
  const Vec<double, Dim> direction = p.point[i].frame * Vec<double, Dim>(std::cos(angle), std::sin(angle));
  if (std::abs(direction[1]) > std::abs(direction[0])) return 0.0;
  const double counts = (1.0 - 2.0 * other / largest) * (1.0 - borne / largest);
  return counts * std::clamp(direction[1] / direction[0], -most_lean, most_lean);
}

template <int Dim>
void ReferenceBody<Dim>::straighten(Index first, Index last) {
  const Particles<Dim>& p = this->run_.particles;
  for (std::size_t i = lanes_begin(first); i < std::min(lanes_begin(last), p.count); ++i) {
    if (p.kind[i] != kind::cracked || p.point[i].crack.integrity < CrackBands<Dim>::least_integrity) continue;
    // Only while the crack grows: a row that followed the vibrations of a crack would feed them.
    if (p.point[i].crack.integrity > grown * straightened_[i]) continue;
    straightened_[i] = p.point[i].crack.integrity;
    const Full c = correction_of_row(moment_of_row(i));
    leans_[i] = lean_of(i, c);
    set_correction(i, c);
    set_flux(i, {p.stress[0][i], p.stress[1][i], p.stress[2][i]});
  }
}

template <int Dim>
std::vector<int> ReferenceBody<Dim>::released_by(std::size_t i) const {
  const Particles<Dim>& p = this->run_.particles;
  const CohesiveState<double, Dim>& crack = p.point[i].crack;
  std::vector<int> cut;
  if (!(crack.jump[0] > 0.0)) return cut;
  // The crack's normal in the undeformed body.
  const double nx = p.point[i].frame(0, 0);
  const double ny = p.point[i].frame(0, 1);
  for (const int neighbour : this->lists_[i]) {
    const auto j = static_cast<std::size_t>(neighbour);
    const double rx = p.start[0][j] - p.start[0][i];
    const double ry = p.start[1][j] - p.start[1][i];
    // Displacement of j seen from i, turned back by the rotation of i.
    const double gx = p.position[0][j] - p.position[0][i];
    const double gy = p.position[1][j] - p.position[1][i];
    const double ux = p.rotation[0][i] * gx + p.rotation[1][i] * gy - rx;
    const double uy = p.rotation[0][i] * gy - p.rotation[1][i] * gx - ry;
    const double along = nx * rx + ny * ry;
    const double opening = (nx * ux + ny * uy) * (along < 0.0 ? -1.0 : 1.0);
    if (opening >= 0.5 * crack.jump[0]) cut.push_back(neighbour);
  }
  return cut;
}

template <int Dim>
void ReferenceBody<Dim>::release_bonds() {
  const Particles<Dim>& p = this->run_.particles;
  NeighbourLists& lists = this->lists_;
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] != kind::cracked) continue;
    if (p.point[i].crack.integrity >= this->run_.setup.options.release_integrity) continue;
    for (const int j : released_by(i)) {
      std::erase(lists[i], j);
      std::erase(lists[static_cast<std::size_t>(j)], static_cast<int>(i));
      changed.push_back(i);
      changed.push_back(static_cast<std::size_t>(j));
      ++this->released_;
    }
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  for (const std::size_t i : changed) {
    leans_[i] = 0.0;  // the bonds that are left see less of the crack, or none of it
    write_row(i);
  }
}

template <int Dim>
void ReferenceBody<Dim>::save(Writer& archive) const {
  this->transfer_lists(archive, *this);
  archive(leans_);
  archive(straightened_);
  if (bands_) CrackBands<Dim>::transfer(archive, *bands_);
}

template <int Dim>
void ReferenceBody<Dim>::load(Reader& archive) {
  this->transfer_lists(archive, *this);
  archive(leans_);
  archive(straightened_);
  if (bands_) CrackBands<Dim>::transfer(archive, *bands_);
  // Rows keep their place; only what was cut since the start differs.
  for (std::size_t i = 0; i < this->run_.particles.count; ++i) write_row(i);
  this->point_bonds();
}

template class ReferenceBody<2>;

}  // namespace fpz::sph::detail
