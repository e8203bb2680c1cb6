#include "fpz/sph/area_vectors.hpp"

#include <stdexcept>

#include "engine.hpp"
#include "plane.hpp"

namespace fpz::sph {

template <int Dim>
std::vector<Vec<double, Dim>> area_vectors(const RunSetup<Dim>& setup) {
  RunSetup<Dim> bare = setup;
  bare.loads.clear();
  bare.velocity.clear();
  bare.initial_stress.setZero();
  std::string text;
  for (const std::string& problem : problems(bare)) text += problem + "\n";
  if (bare.options.momentum != MomentumForm::adjoint) text += "pressure on a surface needs the momentum form adjoint\n";
  if (!text.empty()) throw std::invalid_argument(text.substr(0, text.size() - 1));
  detail::Engine<Dim> engine(bare, 1.0);
  engine.body->start();
  detail::RunData<Dim>& run = engine.run;
  Particles<Dim>& p = run.particles;
  for (Field& u : p.velocity) std::fill(u.begin(), u.end(), 0.0);
  for (std::size_t i = 0; i < p.count; ++i) {
    const detail::Full l = {p.correction[0][i], p.correction[2][i], p.correction[3][i], p.correction[1][i]};
    const detail::Full t = detail::flux_of(1.0, 0.0, detail::Symmetric{1.0, 1.0, 0.0}, l);
    p.flux[0][i] = t.xx, p.flux[1][i] = t.xy, p.flux[2][i] = t.yx, p.flux[3][i] = t.yy;
  }
  detail::View<Dim> view = run.view;
  view.step = 1.0;
  view.damped = view.controlled = view.pushed = false;
  for (double& g : view.gravity) g = 0.0;
  engine.body->force(view);
  std::vector<Vec<double, Dim>> area(p.count);
  for (std::size_t i = 0; i < p.count; ++i) {
    for (int c = 0; c < Dim; ++c) area[p.id[i]][c] = -p.mass[i] * p.acceleration[static_cast<std::size_t>(c)][i];
  }
  return area;
}

template std::vector<Vec<double, 2>> area_vectors<2>(const RunSetup<2>&);

}  // namespace fpz::sph
