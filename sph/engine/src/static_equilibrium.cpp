#include "fpz/sph/static_equilibrium.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine.hpp"
#include "plane.hpp"

namespace fpz::sph {

namespace {

using Values = Eigen::VectorXd;  // one component after the other, in the order of the slots

template <int Dim>
void require_sound(const RunSetup<Dim>& setup) {
  std::string text;
  for (const std::string& problem : problems(setup)) text += problem + "\n";
  if (setup.options.configuration != Configuration::reference || setup.options.momentum != MomentumForm::adjoint) {
    text += "static equilibrium needs the configuration reference and the momentum form adjoint\n";
  }
  for (const Group<Dim>& g : setup.groups) {
    const bool yields = std::any_of(g.drive.begin(), g.drive.end(), [](const auto& d) { return d && d->yields(); });
    if (yields || g.hinge) {
      text += "static equilibrium knows no group that yields to forces: " + g.name + "\n";
    }
  }
  if (!setup.initial_stress.isZero(0.0)) text += "static equilibrium begins without stress\n";
  if (!setup.loads.empty()) text += "static equilibrium takes its forces from StaticLoad, not from loads\n";
  if (!text.empty()) throw std::invalid_argument(text.substr(0, text.size() - 1));
}

}  // namespace

/// Forces of displacements.
template <int Dim>
struct StaticBody<Dim>::Forces {
  explicit Forces(const RunSetup<Dim>& setup) : engine(setup, 1.0) {
    const Particles<Dim>& p = engine.run.particles;
    mass.resize(size());
    for (Eigen::Index i = 0; i < size(); ++i) mass[i] = p.mass[static_cast<std::size_t>(i) % p.count];
    scatter(Values::Ones(size()), engine.run.particles.velocity);
    for (const auto& boundary : engine.boundaries) boundary->hold();
    free = gather(p.velocity);
  }

  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(engine.run.particles.count); }
  [[nodiscard]] Eigen::Index size() const { return Dim * count(); }
  [[nodiscard]] Eigen::Index slot(std::size_t id) const { return static_cast<Eigen::Index>(engine.run.slot_of[id]); }

  [[nodiscard]] Values operator()(const Values& displacement) {
    constexpr double strain = 1e-12;  // so small that squares of rotations are below rounding
    const double largest = displacement.cwiseAbs().maxCoeff();
    scale = largest > 0.0 ? strain * engine.run.setup.arrangement.spacing / largest : 1.0;
    scatter(scale * displacement, engine.run.particles.velocity);
    engine.accelerate_from_rest();
    return gather(engine.run.particles.acceleration).cwiseProduct(mass) / scale;
  }

  /// In the displacements of the last call. From the strain: not all loops store the stress of a material that may
  /// crack.
  [[nodiscard]] Tensor<double, Dim> stress(std::size_t id) const {
    const Fields<tensor_size<Dim>>& e = engine.run.particles.strain;
    const auto i = static_cast<std::size_t>(slot(id));
    const Elasticity<double>& bulk = engine.run.materials.bulk(i);
    const detail::Symmetric s = detail::elastic_stress(bulk.lambda, bulk.mu, {e[0][i], e[1][i], e[2][i]});
    return Tensor<double, Dim>(s.xx, s.yy, s.xy) / scale;
  }

  [[nodiscard]] Values sorted(const std::vector<Vec<double, Dim>>& list) const {
    Values all = Values::Zero(size());
    for (std::size_t id = 0; id < list.size(); ++id) {
      for (int c = 0; c < Dim; ++c) all[slot(id) + c * count()] = list[id][c];
    }
    return all;
  }
  [[nodiscard]] Vec<double, Dim> at(const Values& all, std::size_t id) const {
    Vec<double, Dim> v;
    for (int c = 0; c < Dim; ++c) v[c] = all[slot(id) + c * count()];
    return v;
  }

  [[nodiscard]] Values gather(const Fields<Dim>& fields) const {
    Values all(size());
    for (int c = 0; c < Dim; ++c) {
      all.segment(c * count(), count()) = Eigen::Map<const Values>(fields[static_cast<std::size_t>(c)].data(), count());
    }
    return all;
  }
  void scatter(const Values& all, Fields<Dim>& fields) const {
    for (int c = 0; c < Dim; ++c) {
      Eigen::Map<Values>(fields[static_cast<std::size_t>(c)].data(), count()) = all.segment(c * count(), count());
    }
  }

  detail::Engine<Dim> engine;
  Values mass;
  Values free;         ///< 0 where a component is prescribed, else 1
  double scale = 1.0;  ///< strain and stress of the engine are those of the displacements times this
};

template <int Dim>
StaticBody<Dim>::StaticBody(const RunSetup<Dim>& setup) {
  require_sound(setup);
  forces_ = std::make_unique<Forces>(setup);
}
template <int Dim>
StaticBody<Dim>::~StaticBody() = default;
template <int Dim>
StaticBody<Dim>::StaticBody(StaticBody&&) noexcept = default;
template <int Dim>
StaticBody<Dim>& StaticBody<Dim>::operator=(StaticBody&&) noexcept = default;

/// Conjugate gradients on load + forces(u) = 0 in the free components, preconditioned by the masses.
template <int Dim>
StaticState<Dim> StaticBody<Dim>::equilibrium(const StaticLoad<Dim>& load) {
  constexpr double tolerance = 1e-9;
  constexpr int most = 100'000;
  Forces& forces = *forces_;
  const Values& free = forces.free;
  const Values outer = forces.sorted(load.force);
  Values u = forces.sorted(load.displacement);
  u -= u.cwiseProduct(free);
  Values r = (outer + forces(u)).cwiseProduct(free);
  const double driving = r.norm();
  StaticState<Dim> state;
  Values z = r.cwiseQuotient(forces.mass), p = z;
  double product = r.dot(z);
  while (r.norm() > tolerance * driving) {
    if (++state.iterations > most) {
      throw std::runtime_error("no static equilibrium: is the load of a body that can move freely in balance?");
    }
    const Values change = forces(p).cwiseProduct(free);
    const double length = -product / p.dot(change);
    u += length * p;
    r += length * change;
    z = r.cwiseQuotient(forces.mass);
    const double before = product;
    product = r.dot(z);
    p = z + product / before * p;
  }
  const Values rest = outer + forces(u);
  if (driving > 0.0) state.residual = rest.cwiseProduct(free).norm() / driving;
  const Values reaction = rest.cwiseProduct(free) - rest;
  const RunSetup<Dim>& setup = forces.engine.run.setup;
  state.reaction.assign(setup.groups.size(), Vec<double, Dim>::Zero());
  for (std::size_t id = 0; id < setup.arrangement.size(); ++id) {
    state.displacement.push_back(forces.at(u, id));
    state.stress.push_back(forces.stress(id));
    const int g = setup.arrangement.group[id];
    if (g >= 0) state.reaction[static_cast<std::size_t>(g)] += forces.at(reaction, id);
  }
  return state;
}

template class StaticBody<2>;

}  // namespace fpz::sph
