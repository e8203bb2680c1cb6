#include "fpz/sph/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine.hpp"
#include "fpz/energy.hpp"
#include "fpz/out_of_plane.hpp"

namespace fpz::sph {

/// eq 32.
template <int Dim>
double courant_step(const RunSetup<Dim>& s) {
  double sound = 0.0;
  for (std::size_t k = 0; k < s.materials.count(); ++k) {
    sound = std::max(sound, std::sqrt(parameters_of(s, k).young_modulus / parameters_of(s, k).density));
  }
  return s.options.courant * s.options.smoothing_ratio * s.arrangement.spacing / sound *
         std::sqrt(s.options.mass_scale);
}

namespace {

template <int Dim>
double most_damping(const RunSetup<Dim>& s) {
  return std::max(s.options.damping, s.most_damping);
}

/// The longest time step of a run whose elastic body has the limit `elastic_limit` (s).
template <int Dim>
double longest_step(const RunSetup<Dim>& s, double elastic_limit) {
  return stability_margin * elastic_limit / std::sqrt(1.0 + most_damping(s));
}

}  // namespace

template <int Dim>
double time_step(const RunSetup<Dim>& s) {
  return std::min(courant_step(s), longest_step(s, stability_limit(s)));
}

namespace {

/// The engine of a run; its bonds serve the stability limit too where that is measured on the same ones.

template <int Dim>
std::unique_ptr<detail::Engine<Dim>> make_engine(const RunSetup<Dim>& setup) {
  std::string text;
  for (const std::string& problem : problems(setup)) text += (text.empty() ? "" : "\n") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
  auto engine = std::make_unique<detail::Engine<Dim>>(setup, 1.0);
  const double limit =
      setup.options.configuration == Configuration::reference ? engine->stability_limit() : stability_limit(setup);
  engine->run.set_time_step(std::min(courant_step(setup), longest_step(setup, limit)));
  return engine;
}

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(const RunSetup<Dim>& setup) : engine_(make_engine(setup)) {}
template <int Dim>
Simulation<Dim>::~Simulation() = default;
template <int Dim>
Simulation<Dim>::Simulation(Simulation&&) noexcept = default;
template <int Dim>
Simulation<Dim>& Simulation<Dim>::operator=(Simulation&&) noexcept = default;

template <int Dim>
Outcome Simulation<Dim>::step() {
  return engine_->step();
}
template <int Dim>
double Simulation<Dim>::time() const {
  return engine_->run.now();
}
template <int Dim>
double Simulation<Dim>::time_step() const {
  return engine_->run.dt;
}
template <int Dim>
long long Simulation<Dim>::steps() const {
  return engine_->run.steps;
}
template <int Dim>
double Simulation<Dim>::loading_time() const {
  return engine_->run.loading_time();
}
template <int Dim>
double Simulation<Dim>::pace() const {
  return engine_->run.clock.pace;
}
template <int Dim>
long long Simulation<Dim>::loading_steps() const {
  constexpr double rounding = 1e-6;  // of a step: of a sum over many changes of the pace
  return static_cast<long long>(engine_->run.loading_time() / engine_->run.dt + rounding);
}
template <int Dim>
const Particles<Dim>& Simulation<Dim>::particles() const {
  engine_->run.watched = true;
  return particles_now();
}
template <int Dim>
const Particles<Dim>& Simulation<Dim>::particles_now() const {
  engine_->body->show();
  return engine_->run.particles;
}
template <int Dim>
const Particles<Dim>& Simulation<Dim>::motions_now() const {
  return engine_->run.particles;
}
template <int Dim>
std::size_t Simulation<Dim>::count() const {
  return engine_->run.particles.count;
}
template <int Dim>
std::size_t Simulation<Dim>::slot(std::size_t id) const {
  return engine_->run.slot_of.at(id);
}
template <int Dim>
Vec<double, Dim> Simulation<Dim>::reaction(std::size_t group) const {
  return engine_->boundaries.at(group)->reaction();
}
template <int Dim>
Vec<double, Dim> Simulation<Dim>::velocity(std::size_t group) const {
  return engine_->boundaries.at(group)->velocity();
}
template <int Dim>
double Simulation<Dim>::factor(std::size_t load) const {
  return engine_->boundaries.at(engine_->run.setup.groups.size() + load)->factor();
}

template <int Dim>
void Simulation<Dim>::set_pace(double pace) {
  if (!(pace >= 0.0 && std::isfinite(pace))) {
    throw std::invalid_argument("pace = " + std::to_string(pace) + ": must be a number, not below 0");
  }
  detail::RunData<Dim>& run = engine_->run;
  run.clock.change(pace, run.steps, run.dt);
}

namespace {

void require_usable(const TimeTable& table) {
  const std::string problem = problem_of(table);
  if (!problem.empty()) throw std::invalid_argument("the table " + problem);
}

}  // namespace

template <int Dim>
void Simulation<Dim>::set_drive(std::size_t group, std::size_t component, const Drive& drive) {
  require_usable(drive.table);
  engine_->boundaries.at(group)->set_drive(component, drive);
}
template <int Dim>
void Simulation<Dim>::steer(std::size_t group, std::size_t component, double velocity) {
  engine_->boundaries.at(group)->steer(component, velocity);
}
template <int Dim>
void Simulation<Dim>::set_factor(std::size_t load, const TimeTable& factor) {
  require_usable(factor);
  engine_->boundaries.at(engine_->run.setup.groups.size() + load)->set_factor(factor);
}
template <int Dim>
void Simulation<Dim>::set_damping(double part) {
  const double most = most_damping(engine_->run.setup);
  if (!(part >= 0.0 && part <= most)) {
    throw std::invalid_argument("damping = " + std::to_string(part) + ": must be within 0 and " + std::to_string(most) +
                                ", the most that the set-up says (most_damping)");
  }
  engine_->run.set_damping(part);
}

template <int Dim>
Energies Simulation<Dim>::energies() const {
  engine_->body->show();
  return engine_->energies();
}
template <int Dim>
long long Simulation<Dim>::released_bonds() const {
  return engine_->body->released();
}
template <int Dim>
long long Simulation<Dim>::neighbour_builds() const {
  return engine_->body->builds();
}

template <int Dim>
std::size_t Simulation<Dim>::cracked() const {
  std::size_t n = 0;
  for (const double k : engine_->run.particles.kind) n += k == kind::cracked ? 1 : 0;
  return n;
}

template <int Dim>
bool Simulation<Dim>::cracked_on_weak_plane(std::size_t slot) const {
  return engine_->run.materials.cracked_on_weak_plane(slot);
}

template <int Dim>
std::size_t Simulation<Dim>::failing_out_of_plane() const {
  const detail::RunData<Dim>& run = engine_->run;
  const Particles<Dim>& p = particles_now();
  std::size_t n = 0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] != kind::intact) continue;
    const Material<double> m = run.materials.material(i, p.length[i]);
    const double nothing = 1e-6 * m.law.surface.cohesion;  // those about to crack are on the surface
    n += failure_value_in_space(m, p.stress_of(i)) > nothing ? 1U : 0U;
  }
  return n;
}

template <int Dim>
double Simulation<Dim>::alternation() const {
  return engine_->control ? engine_->control->alternation() : std::nan("");
}

template <int Dim>
double Simulation<Dim>::overlap() const {
  return engine_->contact ? engine_->contact->overlap() : std::nan("");
}

template <int Dim>
double Simulation<Dim>::mean_neighbours() const {
  std::size_t n = 0;
  for (const std::vector<int>& list : engine_->body->lists()) n += list.size();
  return static_cast<double>(n) / static_cast<double>(count());
}

template double courant_step<2>(const RunSetup<2>&);
template double time_step<2>(const RunSetup<2>&);
template class Simulation<2>;

}  // namespace fpz::sph
