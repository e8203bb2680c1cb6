#include "reference_body.hpp"

#include <algorithm>

#include "across_crack.hpp"
#include "chunks.hpp"

namespace fpz::sph::detail {

namespace {
// Steps between changes of H: openings grow slowly.
constexpr long long band_interval = 4;
}  // namespace

template <int Dim>
ReferenceBody<Dim>::ReferenceBody(RunData<Dim>& run)
    : Body<Dim>(run, run.passes->force_reference), rows_(make_rows()), crack_rows_(run, rows_) {
  this->builds_ = 1;
  this->point_bonds();
  if (run.setup.options.rve_length.rule == RveLength::Rule::band) bands_.emplace(run);
}

template <int Dim>
BondRows<Dim> ReferenceBody<Dim>::make_rows() {
  RunData<Dim>& run = this->run_;
  const Particles<Dim>& p = run.particles;
  const Arrangement<Dim>& a = run.setup.arrangement;
  this->lists_ = find_neighbours<Dim>(run.team, p.start, p.count, kernel_support * run.h);
  drop_without_share<Dim>(this->lists_, a.cuts, p.start, a.spacing);
  run.keep_apart(this->lists_);
  return BondRows<Dim>(run, this->lists_, this->bonds_);
}

/// Of an initial stress.
template <int Dim>
void ReferenceBody<Dim>::start() {
  const Particles<Dim>& p = this->run_.particles;
  for (std::size_t i = 0; i < p.count; ++i) set_flux(i, {p.stress[0][i], p.stress[1][i], p.stress[2][i]});
}

template <int Dim>
bool ReferenceBody<Dim>::changes_rows() const {
  return this->run_.setup.options.release_integrity > 0.0 && this->run_.steps % release_interval == 0;
}

/// Its row is straightened, or the zero-energy control lets go of it.
template <int Dim>
bool ReferenceBody<Dim>::moves_on(std::size_t i) const {
  const View<Dim>& view = this->run_.view;
  return (bands_ && this->run_.steps % band_interval == 0) || (view.controlled && view.control_share[i] != 0.0);
}

template <int Dim>
Outcome ReferenceBody<Dim>::advance(const Kick& kick) {
  RunData<Dim>& run = this->run_;
  View<Dim> view = run.view;
  view.lean = run.hidden = !run.watched;
  const Outcome outcome =
      this->strain_with(kick, [&](Index first, Index last) { run.passes->strain_reference(view, first, last); });
  const Options<Dim>& o = run.setup.options;
  const bool follows = bands_ && o.momentum == MomentumForm::adjoint;
  if (bands_ && run.steps % band_interval == 0) bands_->follow();
  if (follows && run.steps % band_interval == 0) {
    run.for_cracked([this](std::size_t i) { straighten(i); });
  }
  if (o.release_integrity > 0.0 && run.steps % release_interval == 0) {
    if (follows) crack_rows_.narrow();
    const std::size_t before = this->fresh_.size();
    crack_rows_.release(this->fresh_);
    this->released_ += static_cast<long long>(this->fresh_.size() - before);
  }
  return outcome;
}

template <int Dim>
void ReferenceBody<Dim>::show() {
  RunData<Dim>& run = this->run_;
  if (!run.hidden) return;
  run.for_chunks([&](Index first, Index last) { run.passes->show_reference(run.view, first, last); });
  run.hidden = false;
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
bool ReferenceBody<Dim>::forget_crack(std::size_t i, const State<double, Dim>& state) {
  if (!bands_) return false;  // its strain would have no place
  bands_->forget(i, state.strain - this->run_.particles.point[i].strain);
  crack_rows_.forget(i);
  return true;
}

template <int Dim>
void ReferenceBody<Dim>::set_flux(std::size_t i, const Symmetric& stress) {
  rows_.set_flux(i, stress);
}

template <int Dim>
void ReferenceBody<Dim>::push() {
  for (const auto& [i, force] : rows_.take_half_way()) {
    for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
      this->run_.outer_force[c][i] += force[static_cast<int>(c)];
    }
  }
}

template <int Dim>
void ReferenceBody<Dim>::straighten(std::size_t i) {
  const Particles<Dim>& p = this->run_.particles;
  if (crack_rows_.straighten(i)) set_flux(i, {p.stress[0][i], p.stress[1][i], p.stress[2][i]});
}

template <int Dim>
void ReferenceBody<Dim>::save(Writer& archive) const {
  transfer(archive, *this);
}

template <int Dim>
void ReferenceBody<Dim>::load(Reader& archive) {
  transfer(archive, *this);
  // Rows keep their place; only what was cut or narrowed since the start differs.
  rows_.write_all();
  this->point_bonds();
}

template class ReferenceBody<2>;

}  // namespace fpz::sph::detail
