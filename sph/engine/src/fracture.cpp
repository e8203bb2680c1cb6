// The particles that the lane loops cannot finish: cracked ones and candidates for onset go through fpz::update.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

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

namespace {

/// Calls f(i) for the flagged ones of particles [first, last), ascending, as long as it returns true.
template <class F>
void for_flagged(const Mask& flagged, std::size_t first, std::size_t last, F&& f) {
  static_assert(lanes == sizeof(std::uint64_t));
  for (std::size_t o = first; o < last; o += lanes) {
    std::uint64_t all = 0;  // most blocks have none
    std::memcpy(&all, &flagged[o], sizeof all);
    if (all == 0) continue;
    for (std::size_t i = o; i < o + lanes; ++i) {
      if (flagged[i] != 0 && !f(i)) return;
    }
  }
}

/// Fetches what an update reads first, without waiting for it: the states of cracks lie far apart.
template <class T>
void fetch(const T& x) {
  constexpr std::size_t line = 64;
  const char* at = reinterpret_cast<const char*>(&x);
  for (std::size_t k = 0; k < sizeof(T); k += line) __builtin_prefetch(at + k, 1);
}

}  // namespace

template <int Dim>
typename Body<Dim>::Report Body<Dim>::update_flagged(Index first, Index last) {
  Report report;
  const Particles<Dim>& p = run_.particles;
  const std::size_t begin = lanes_begin(first), end = lanes_begin(last);
  for_flagged(run_.flagged, begin, end, [&](std::size_t i) {
    if (i < p.count) fetch(p.point[i]);
    return true;
  });
  for_flagged(run_.flagged, begin, end, [&](std::size_t i) {
    if (i >= p.count) return false;  // padding
    const bool was = p.kind[i] == kind::cracked;
    const Outcome outcome = update_particle(i);
    if (report.outcome.ok()) report.outcome = outcome;
    report.has_cracked = report.has_cracked || (!was && p.kind[i] == kind::cracked);
    if (sweep_.in_one() && p.kind[i] == kind::cracked && moves_on(i)) sweep_.hold_around(run_.view, i);
    return true;
  });
  return report;
}

template <int Dim>
bool Body<Dim>::wants_another_plane(std::size_t i, const Material<double>& m) const {
  const double most = run_.setup.options.reorientation_damage;
  const State<double, Dim>& point = run_.particles.point[i];
  if (!(damage(point.crack) < most) || surely_intact<Dim>(m, point.stress)) return false;
  if (run_.materials.cracked_on_weak_plane(i)) return false;
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
  if (!forget_crack(i, intact)) return p.point[i];
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
  const Particles<Dim>& p = run_.particles;
  Material<double> m = run_.materials.material(i, p.length[i]);
  const bool goes_on = p.kind[i] == kind::cracked && !wants_another_plane(i, m);
  const fpz::Report report = goes_on ? update_crack(i, m) : update_onset(i, m);
  if (report.status == Status::snap_back && shorten_band(i)) return update_particle(i);
  if (!report.ok()) return {Failure::constitutive, report.status, p.id[i], run_.now(), 0.0};
  return {};
}

/// A crack that goes on as it is: in place, as nothing is written before all is known.
template <int Dim>
fpz::Report Body<Dim>::update_crack(std::size_t i, const Material<double>& m) {
  Particles<Dim>& p = run_.particles;
  State<double, Dim>& point = p.point[i];
  const double dissipated = dissipated_energy(m, point);
  const fpz::Report report = update<Dim>(m, run_.update_options, point, strain_increment(i, point), point);
  if (report.ok()) finish(i, m, dissipated);
  return report;
}

template <int Dim>
fpz::Report Body<Dim>::update_onset(std::size_t i, Material<double>& m) {
  Particles<Dim>& p = run_.particles;
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
  if (!report.ok()) return report;
  if (point.cracked) {
    p.kind[i] = kind::cracked;
    p.point[i] = point;
    finish(i, m, dissipated_energy(m, begin));
  } else {
    turn(i, point);
    set_stress(i, point.stress);
  }
  return report;
}

/// What follows from the updated point of a cracked particle, `dissipated` (J/m^3) being what it had dissipated before.
template <int Dim>
void Body<Dim>::finish(std::size_t i, const Material<double>& m, double dissipated) {
  Particles<Dim>& p = run_.particles;
  // With the volume of this step: in `updated` a particle grows by its crack, and so does the work done on it.
  p.fracture[i] += p.volume[i] * (dissipated_energy(m, p.point[i]) - dissipated);
  turn(i, p.point[i]);
  set_stress(i, p.point[i].stress);
}

template <int Dim>
void Body<Dim>::set_stress(std::size_t i, const Tensor<double, Dim>& stress) {
  Particles<Dim>& p = run_.particles;
  const Symmetric s = {stress[0], stress[1], stress[2]};
  p.stress[0][i] = s.xx;
  p.stress[1][i] = s.yy;
  p.stress[2][i] = s.xy;
  set_flux(i, s);
}

template double Body<2>::band_length(std::size_t, const Vec<double, 2>&) const;
template void Body<2>::set_band_length(std::size_t, const Vec<double, 2>&);
template Body<2>::Report Body<2>::update_flagged(Index, Index);
template Outcome Body<2>::update_particle(std::size_t);

}  // namespace fpz::sph::detail
