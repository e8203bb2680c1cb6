// The particles that the lane loops cannot finish: cracked ones and candidates for onset go through fpz::update.
#include <algorithm>
#include <cmath>

#include "body.hpp"
#include "fpz/energy.hpp"
#include "fpz/onset.hpp"
#include "fpz/sph/band.hpp"
#include "fpz/update.hpp"
#include "weak_plane.hpp"

namespace fpz::sph::detail {

template <int Dim>
double Body<Dim>::band_length(std::size_t i, const Vec<double, Dim>& normal) const {
  const Particles<Dim>& p = run_.particles;
  const Fields<Dim>& x = bond_positions();
  std::vector<Vec<double, Dim>> offsets;
  for (const int neighbour : lists_[i]) {
    Vec<double, Dim>& r = offsets.emplace_back();
    for (std::size_t c = 0; c < run_.dimensions; ++c) {
      r[static_cast<int>(c)] = x[c][static_cast<std::size_t>(neighbour)] - x[c][i];
    }
  }
  const double size = Dim == 2 ? std::sqrt(p.volume[i]) : std::cbrt(p.volume[i]);
  return band_width<Dim>(size, normal, offsets);
}

template <int Dim>
void Body<Dim>::set_band_length(std::size_t i, const Vec<double, Dim>& normal) {
  if (run_.setup.options.rve_length.rule == RveLength::Rule::band) run_.particles.length[i] = band_length(i, normal);
}

template <int Dim>
typename Body<Dim>::Report Body<Dim>::update_flagged(Index first, Index last) {
  Report report;
  const Mask& flagged = run_.flagged;
  for (std::size_t o = lanes_begin(first); o < lanes_begin(last); o += lanes) {
    if (std::find(&flagged[o], &flagged[o] + lanes, 1) == &flagged[o] + lanes) continue;
    for (std::size_t i = o; i < std::min(o + lanes, run_.particles.count); ++i) {
      if (flagged[i] == 0) continue;
      const bool was = run_.particles.kind[i] == kind::cracked;
      report.outcome = update_particle(i);
      if (!report.outcome.ok()) return report;
      report.has_cracked = report.has_cracked || (!was && run_.particles.kind[i] == kind::cracked);
    }
  }
  return report;
}

template <int Dim>
bool Body<Dim>::wants_another_plane(std::size_t i, const Material<double>& m) const {
  const double most = run_.setup.options.reorientation_damage;
  const State<double, Dim>& point = run_.particles.point[i];
  if (!(damage(point.crack) < most) || run_.materials.cracked_on_weak_plane(i)) return false;
  // Its own has softened: one that fails is another.
  return critical_plane<Dim>(m, point.stress).failure_value > 0.0;
}

template <int Dim>
State<double, Dim> Body<Dim>::state_at_begin(std::size_t i, Material<double>& m) {
  Particles<Dim>& p = run_.particles;
  State<double, Dim> intact;
  intact.stress = p.stress_of(i);
  intact.strain = elastic_strain<Dim>(m.bulk, intact.stress);
  if (p.kind[i] != kind::cracked) return intact;
  if (!wants_another_plane(i, m) || !forget_crack(i, intact)) return p.point[i];
  // What it has opened stays as a strain without stress, what that took as fracture energy; its springs let go.
  run_.ledger.viscous[i / lanes] += p.volume[i] / p.length[i] * free_energy(m.law, p.point[i].crack);
  open_crack<Dim>(m, run_.update_options, intact);
  set_band_length(i, intact.frame.row(0).transpose());
  set_rve_length(m, p.length[i]);
  p.point[i] = intact;
  return intact;
}

/// eq 21 for a particle that is, or may now become, cracked.
template <int Dim>
Outcome Body<Dim>::update_particle(std::size_t i) {
  Particles<Dim>& p = run_.particles;
  Material<double> m = run_.materials.material(i, p.length[i]);
  const State<double, Dim> begin = state_at_begin(i, m);
  State<double, Dim> point = begin;
  const Tensor<double, Dim> increment = strain_increment(i, begin);
  fpz::Report report;
  if (const auto opened = opened_weak_plane<Dim>(run_.materials, i, begin, increment)) {
    run_.materials.crack_on_weak_plane(i);
    set_band_length(i, opened->state.frame.row(0).transpose());
    m = run_.materials.material(i, p.length[i]);
    report = update<Dim>(m, run_.update_options, opened->state, opened->rest, point);
  } else {
    report = update<Dim>(m, run_.update_options, begin, increment, point);
    if (report.ok() && report.onset && run_.setup.options.rve_length.rule == RveLength::Rule::band) {
      // The plane is known now and does not depend on H: once more with the H that belongs to it.
      set_band_length(i, point.frame.row(0).transpose());
      set_rve_length(m, p.length[i]);
      report = update<Dim>(m, run_.update_options, begin, increment, point);
    }
  }
  if (report.status == Status::snap_back && shorten_band(i)) return update_particle(i);
  if (!report.ok()) return {Failure::constitutive, report.status, p.id[i], run_.now(), 0.0};
  turn(i, point);
  if (point.cracked) {
    // With the volume of this step: in `updated` a particle grows by its crack, and so does the work done on it.
    p.fracture[i] += p.volume[i] * (dissipated_energy(m, point) - dissipated_energy(m, begin));
    p.kind[i] = kind::cracked;
    p.point[i] = point;
  }
  const Symmetric s = {point.stress[0], point.stress[1], point.stress[2]};
  p.stress[0][i] = s.xx;
  p.stress[1][i] = s.yy;
  p.stress[2][i] = s.xy;
  set_flux(i, s);
  return {};
}

template double Body<2>::band_length(std::size_t, const Vec<double, 2>&) const;
template void Body<2>::set_band_length(std::size_t, const Vec<double, 2>&);
template Body<2>::Report Body<2>::update_flagged(Index, Index);
template Outcome Body<2>::update_particle(std::size_t);

}  // namespace fpz::sph::detail
