// The complete state of a run as bytes (archive.hpp): fingerprint of the set-up, then what changes during a run.
#include <stdexcept>

#include "engine.hpp"
#include "fpz/sph/archive.hpp"
#include "fpz/sph/option_table.hpp"

namespace fpz::sph {

namespace {

constexpr std::uint64_t magic = 0x344850535a5046ULL;  // "FPZSPH4"; the last figure is the version

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
  for (const auto& p : parameter_table<double>) {
    if (p.of_material) w(s.parameters.*p.member);
  }
  w(s.arrangement.spacing);
  w(s.arrangement.position);
  w(s.arrangement.volume);
  w(s.arrangement.group);
  w(s.velocity);
  for (const Cut<Dim>& cut : s.arrangement.cuts) w(cut.corner);
  for (const Group<Dim>& g : s.groups) {
    w(g.elastic);
    for (const std::optional<Motion>& m : g.motion) {
      w(m.has_value());
      w(m ? m->speed : 0.0);
      w(m ? m->ramp : 0.0);
    }
  }
  return fnv1a(w.bytes());
}

}  // namespace

template <class A, class S>
requires std::same_as<std::remove_const_t<S>, State<double, 2>> ||
    std::same_as<std::remove_const_t<S>, State<double, 3>>
void transfer(A& archive, S& s) {
  archive(s.strain);
  archive(s.stress);
  archive(s.cracked);
  archive(s.frame);
  archive(s.crack.traction);
  archive(s.crack.jump);
  archive(s.crack.plastic_jump);
  archive(s.crack.offset);
  archive(s.crack.slip);
  archive(s.crack.integrity);
  archive(s.crack.dissipated);
}

namespace {

/// Everything that changes during a run. What follows from it (weights, flags, views) is made anew after reading.
template <class A, class E>
void visit(A& archive, E& e) {
  auto& p = e.particles;
  archive(e.steps);
  archive(e.started);
  archive(e.prescribed_work);
  archive(e.kinetic_start);
  archive(e.builds);
  archive(e.released);
  archive(p.position);
  archive(p.velocity);
  archive(p.acceleration);
  archive(p.predicted);
  archive(p.stress);
  archive(p.strain);
  archive(p.correction);
  archive(p.artificial);
  archive(p.gradient);
  archive(p.flux);
  archive(p.rotation);
  archive(p.volume);
  archive(p.density);
  archive(p.kind);
  archive(p.length);
  archive(p.fracture);
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] == kind::cracked) archive(p.point[i]);
  }
  archive(e.damping_work);
  archive(e.viscous_work);
  archive(e.artificial_work);
  archive(e.damping_next);
  archive(e.viscous_force);
  archive(e.artificial_force);
  archive(e.control_work);
  archive(e.control_next);
  archive(e.built_at);
  archive(e.lists);
  archive(e.reaction);
  archive(e.group_velocity);
}

}  // namespace

template <int Dim>
std::vector<unsigned char> Simulation<Dim>::snapshot() const {
  Writer w(magic);
  w(fingerprint(engine_->setup));
  visit(w, std::as_const(*engine_));
  return std::move(w).sealed();
}

template <int Dim>
void Simulation<Dim>::restore(std::span<const unsigned char> bytes) {
  try {
    Reader r(bytes, magic);
    std::uint64_t print = 0;
    r(print);
    if (print != fingerprint(engine_->setup)) throw ArchiveError("it is of another set-up");
    visit(r, *engine_);
    if (r.left() != 0) throw ArchiveError("it is too long");
  } catch (const ArchiveError& e) {
    throw std::runtime_error(std::string("snapshot: ") + e.what());
  }
  engine_->remake_bonds();
}

template std::vector<unsigned char> Simulation<2>::snapshot() const;
template void Simulation<2>::restore(std::span<const unsigned char>);

}  // namespace fpz::sph
