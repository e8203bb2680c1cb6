// The complete state of a run as bytes (archive.hpp): fingerprint of the set-up, then what changes during a run.
#include <stdexcept>

#include "engine.hpp"
#include "fpz/sph/archive.hpp"
#include "fpz/sph/option_table.hpp"
#include "fpz/state_fields.hpp"

namespace fpz::sph {

namespace {

constexpr std::uint64_t magic = 0x444850535a5046ULL;  // "FPZSPHD"; the last letter is the version

/// Adds the options on which the result depends.
struct OptionPrint {
  Writer& archive;
  template <Scalar T>
  void operator()(const OptionInfo& info, const T& x) const {
    if (info.changes_result) archive(x);
  }
  void operator()(const OptionInfo& info, const RveLength& x) const {
    (*this)(info, x.rule);
    (*this)(info, x.value);
  }
  template <int N>
  void operator()(const OptionInfo& info, const Vec<double, N>& x) const {
    for (int c = 0; c < N; ++c) (*this)(info, x[c]);
  }
};

/// What defines the run, as a hash: a snapshot continues only the same run. Threads and instruction set do not matter.
template <int Dim>
std::uint64_t fingerprint(const RunSetup<Dim>& s) {
  Writer w;
  w(Dim);
  w(s.setting);
  for_each_option(s.options, OptionPrint{w});
  const auto print = [&w](const Parameters& material) {
    for (const auto& p : parameter_table<double>) {
      if (p.of_material) w(material.*p.member);
    }
    visit_choices(material.choices, [&w](const char*, auto choice) { w(choice); });
  };
  for (std::size_t k = 0; k < s.materials.count(); ++k) print(parameters_of(s, k));
  w(s.materials.of_particle);
  w(s.materials.strength_factor);
  for (const Parameters& plane : s.weak_planes.parameters) print(plane);
  w(s.weak_planes.of_particle);
  w(s.weak_planes.normal);
  w(s.arrangement.spacing);
  w(s.arrangement.position);
  w(s.arrangement.volume);
  w(s.arrangement.group);
  for (const auto& line : s.arrangement.surface) w(line);
  w(s.velocity);
  w(s.initial_stress);
  for (const Cut<Dim>& cut : s.arrangement.cuts)
    w(cut.corner), w(cut.is_tip), w(cut.width), w(cut.gap), w(cut.friction);
  for (const Group<Dim>& g : s.groups) {
    w(g.elastic);
    for (const std::optional<Drive>& d : g.drive) {
      w(d.has_value());
      if (d) w(*d);
    }
    w(g.bonded);
    w(g.keeps_to_itself);
    w(g.hinge.has_value());
    if (g.hinge) w(*g.hinge);
  }
  for (const Load<Dim>& load : s.loads) w(load.force), w(load.factor);
  return fnv1a(w.bytes());
}

}  // namespace

template <class A, class S>
requires std::same_as<std::remove_const_t<S>, State<double, 2>> ||
    std::same_as<std::remove_const_t<S>, State<double, 3>>
void transfer(A& archive, S& state) {
  const auto pass = [&archive](const char*, auto& member) { archive(member); };
  visit_point(state, pass);
  visit_crack(state, pass);
}

namespace detail {

namespace {

/// Clock, ledger and particles; the other parts of a run have their own state.
template <class A, class R>
void transfer_run(A& archive, R& run) {
  archive(run.steps);
  archive(run.started);
  archive(run.clock);
  archive(run.view.damping_part);
  archive(run.view.damped);
  std::remove_cvref_t<decltype(run.ledger)>::transfer_sums(archive, run.ledger);
  std::remove_cvref_t<R>::fields(run, Transfer<A>{archive});
  for (std::size_t i = 0; i < run.particles.count; ++i) {
    if (run.particles.kind[i] == kind::cracked) archive(run.particles.point[i]);
  }
}

}  // namespace

template <int Dim>
void Engine<Dim>::save(Writer& archive) const {
  body->show();
  transfer_run(archive, run);
  run.materials.save(archive);
  body->save(archive);
  for (const auto& boundary : boundaries) boundary->save(archive);
  if (control) control->save(archive);
  if (contact) contact->save(archive);
}

template <int Dim>
void Engine<Dim>::load(Reader& archive) {
  transfer_run(archive, run);
  run.materials.load(archive);
  RunData<Dim>::fields(run, Spoil{run.particles.count});
  run.hidden = false;
  run.find_cracked();
  body->load(archive);
  for (const auto& boundary : boundaries) boundary->load(archive);
  if (control) control->load(archive);
  if (contact) contact->load(archive);
}

template void Engine<2>::save(Writer&) const;
template void Engine<2>::load(Reader&);

}  // namespace detail

template <int Dim>
std::vector<unsigned char> Simulation<Dim>::snapshot() const {
  Writer w(magic);
  w(fingerprint(engine_->run.setup));
  engine_->save(w);
  return std::move(w).sealed();
}

template <int Dim>
void Simulation<Dim>::restore(std::span<const unsigned char> bytes) {
  try {
    Reader r(bytes, magic);
    std::uint64_t print = 0;
    r(print);
    if (print != fingerprint(engine_->run.setup)) throw ArchiveError("it is of another set-up");
    engine_->load(r);
    if (r.left() != 0) throw ArchiveError("it is too long");
  } catch (const ArchiveError& e) {
    throw std::runtime_error(std::string("snapshot: ") + e.what());
  }
}

template std::vector<unsigned char> Simulation<2>::snapshot() const;
template void Simulation<2>::restore(std::span<const unsigned char>);

}  // namespace fpz::sph
