#include "updated_body.hpp"

#include "chunks.hpp"

namespace fpz::sph::detail {

template <int Dim>
UpdatedBody<Dim>::UpdatedBody(RunData<Dim>& run) : Body<Dim>(run, run.passes->force_updated) {
  fields(*this, Allocate{run.particles.padded()});
  rebuild();
}

/// Weights and corrections, without motion.
template <int Dim>
void UpdatedBody<Dim>::start() {
  const RunData<Dim>& run = this->run_;
  View<Dim> v = run.view;
  v.step = 0.0;
  run.for_chunks([&](Index first, Index last) { run.passes->drift_updated(v, first, last); });
  run.for_chunks([&](Index first, Index last) { run.passes->strain_updated(v, first, last); });
}

template <int Dim>
Outcome UpdatedBody<Dim>::advance(const Kick& kick) {
  RunData<Dim>& run = this->run_;
  Particles<Dim>& p = run.particles;
  run.for_chunks([&](Index first, Index last) {
    run.passes->drift_updated(run.view, first, last);
    for (std::size_t i = lanes_begin(first); i < lanes_begin(last); ++i) {
      p.volume[i] = p.mass[i] * run.view.weight_scale / p.density[i];
    }
  });
  if (outdated()) {
    rebuild();
    this->plan_sweep();
  }
  return this->strain_with(kick,
                           [&run](Index first, Index last) { run.passes->strain_updated(run.view, first, last); });
}

template <int Dim>
Tensor<double, Dim> UpdatedBody<Dim>::strain_increment(std::size_t i, const State<double, Dim>&) const {
  Tensor<double, Dim> increment;
  for (std::size_t k = 0; k < this->run_.components; ++k) {
    increment[static_cast<int>(k)] = this->run_.particles.strain[k][i];
  }
  return increment;
}

template <int Dim>
void UpdatedBody<Dim>::turn(std::size_t i, State<double, Dim>& point) const {
  const double cosine = this->run_.particles.rotation[0][i];
  const double sine = this->run_.particles.rotation[1][i];
  Mat<double, Dim, Dim> q;
  q << cosine, -sine, sine, cosine;
  rotate<double, Dim>(point, q);
}

template <int Dim>
void UpdatedBody<Dim>::set_flux(std::size_t i, const Symmetric& stress) {
  Particles<Dim>& p = this->run_.particles;
  const bool plain = this->run_.setup.options.momentum == MomentumForm::paper;
  const Full l =
      full(plain ? Symmetric{1.0, 1.0, 0.0} : Symmetric{p.correction[0][i], p.correction[1][i], p.correction[2][i]});
  const Full t = flux_of(1.0, 0.0, stress, l);
  p.flux[0][i] = t.xx;
  p.flux[1][i] = t.xy;
  p.flux[2][i] = t.yx;
  p.flux[3][i] = t.yy;
  const Symmetric r = tensile_repulsion(this->run_.setup.options.artificial_stress, stress);
  p.artificial[0][i] = r.xx;
  p.artificial[1][i] = r.yy;
  p.artificial[2][i] = r.xy;
}

template <int Dim>
void UpdatedBody<Dim>::rebuild() {
  const RunData<Dim>& run = this->run_;
  const Particles<Dim>& p = run.particles;
  const double skin = run.setup.options.skin * run.setup.arrangement.spacing;
  this->lists_ = find_neighbours<Dim>(this->run_.team, p.position, p.count, kernel_support * run.h + skin);
  separate<Dim>(this->lists_, run.setup.arrangement.cuts, p.start);
  run.keep_apart(this->lists_);
  this->bonds_ = pack<Dim>(this->lists_, p.padded(), Beside::a_number);
  this->point_bonds();
  built_at_ = p.position;
  ++this->builds_;
}

template <int Dim>
bool UpdatedBody<Dim>::outdated() const {
  const Particles<Dim>& p = this->run_.particles;
  const double limit = 0.5 * this->run_.setup.options.skin * this->run_.setup.arrangement.spacing;
  bool outdated = false;
  for (std::size_t i = 0; i < p.count; ++i) {
    double moved = 0.0;
    for (std::size_t c = 0; c < this->run_.dimensions; ++c) {
      const double d = p.position[c][i] - built_at_[c][i];
      moved += d * d;
    }
    outdated |= moved > limit * limit;
  }
  return outdated;
}

template <int Dim>
void UpdatedBody<Dim>::load(Reader& archive) {
  transfer_state(archive, *this);
  this->bonds_ = pack<Dim>(this->lists_, this->run_.particles.padded(), Beside::a_number);
  this->point_bonds();
  this->plan_sweep();
}

template class UpdatedBody<2>;

}  // namespace fpz::sph::detail
