// The particles that the lane loops cannot finish: cracked ones and candidates for onset go through fpz::update.
#include <cmath>

#include "engine.hpp"
#include "fpz/sph/band.hpp"
#include "plane.hpp"

namespace fpz::sph::detail {

namespace {

/// Elastic strain of a stress: the strain of a particle that has not cracked.
template <int Dim>
Tensor<double, Dim> elastic_strain(const Elasticity<double>& bulk, const Tensor<double, Dim>& stress) {
  const double trace = stress.template head<Dim>().sum();
  Tensor<double, Dim> e = stress / (2.0 * bulk.mu);
  const double pressure = bulk.lambda / (Dim * bulk.lambda + 2.0 * bulk.mu) * trace / (2.0 * bulk.mu);
  for (int k = 0; k < Dim; ++k) e[k] -= pressure;
  return e;
}

}  // namespace

template <int Dim>
double Engine<Dim>::band_length(std::size_t i, const Vec<double, Dim>& normal) const {
  const Particles<Dim>& p = particles;
  const Fields<Dim>& x = updated() ? p.position : p.start;
  std::vector<Vec<double, Dim>> offsets;
  for (const int neighbour : lists[i]) {
    Vec<double, Dim>& r = offsets.emplace_back();
    for (std::size_t c = 0; c < dimensions; ++c) {
      r[static_cast<int>(c)] = x[c][static_cast<std::size_t>(neighbour)] - x[c][i];
    }
  }
  const double size = Dim == 2 ? std::sqrt(p.volume[i]) : std::cbrt(p.volume[i]);
  return band_width<Dim>(size, normal, offsets);
}

template <int Dim>
Outcome Engine<Dim>::update_flagged(Index first, Index last) {
  static_assert(Dim == 2, "rotation and flux of plane.hpp");
  Particles<Dim>& p = particles;
  for (std::size_t i = lanes_begin(first); i < std::min(lanes_begin(last), p.count); ++i) {
    if (flagged[i] == 0) continue;
    Material<double> m = material;
    set_rve_length(m, p.length[i]);
    State<double, Dim> point;
    if (p.kind[i] == kind::cracked) {
      point = p.point[i];
    } else {
      point.stress = p.stress_of(i);
      point.strain = elastic_strain<Dim>(m.bulk, point.stress);
    }
    Tensor<double, Dim> increment;
    for (std::size_t k = 0; k < components; ++k) {
      const auto c = static_cast<int>(k);
      increment[c] = updated() ? p.strain[k][i] : p.strain[k][i] - point.strain[c];
    }
    const State<double, Dim> begin = point;
    Report report = update<Dim>(m, update_options, begin, increment, point);
    if (report.ok() && report.onset && setup.options.rve_length.rule == RveLength::Rule::band) {
      // The plane is known now and does not depend on H: once more with the H that belongs to it.
      p.length[i] = band_length(i, point.frame.row(0).transpose());
      set_rve_length(m, p.length[i]);
      report = update<Dim>(m, update_options, begin, increment, point);
    }
    if (!report.ok()) return {Failure::constitutive, report.status, p.id[i], now(), 0.0};
    const double cosine = p.rotation[0][i];
    const double sine = p.rotation[1][i];
    if (updated()) {
      Mat<double, Dim, Dim> q;
      q << cosine, -sine, sine, cosine;
      rotate<double, Dim>(point, q);
    }
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
    const bool plain = updated() && setup.options.momentum == MomentumForm::paper;
    const Symmetric l =
        plain ? Symmetric{1.0, 1.0, 0.0} : Symmetric{p.correction[0][i], p.correction[1][i], p.correction[2][i]};
    const Full t = updated() ? flux_of(1.0, 0.0, s, l) : flux_of(cosine, sine, s, l);
    p.flux[0][i] = t.xx;
    p.flux[1][i] = t.xy;
    p.flux[2][i] = t.yx;
    p.flux[3][i] = t.yy;
    const Symmetric r = tensile_repulsion(setup.options.artificial_stress, s);
    p.artificial[0][i] = r.xx;
    p.artificial[1][i] = r.yy;
    p.artificial[2][i] = r.xy;
  }
  return {};
}

template double Engine<2>::band_length(std::size_t, const Vec<double, 2>&) const;
template Outcome Engine<2>::update_flagged(Index, Index);

}  // namespace fpz::sph::detail
