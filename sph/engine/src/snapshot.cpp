// The complete state as bytes. Layout: magic, version, fingerprint of the scene, the fields below, checksum (FNV-1a of
// all before). Native byte order: a snapshot belongs to one kind of machine.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "engine.hpp"

namespace fpz::sph {

namespace {

constexpr std::uint64_t magic = 0x314850535a5046ULL;  // "FPZSPH1"
constexpr std::uint64_t version = 3;

std::uint64_t fnv(std::span<const unsigned char> bytes) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const unsigned char b : bytes) h = (h ^ b) * 1099511628211ULL;
  return h;
}

class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& x) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(T));
    std::memcpy(bytes.data() + at, &x, sizeof(T));
  }
  template <class T>
  void operator()(std::vector<T>& v) {
    std::uint64_t size = v.size();
    (*this)(size);
    for (T& x : v) (*this)(x);
  }
  std::vector<unsigned char> bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const unsigned char> b) : bytes_(b) {}
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& x) {
    if (bytes_.size() - at_ < sizeof(T)) throw std::runtime_error("snapshot: too short");
    std::memcpy(&x, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
  }
  template <class T>
  void operator()(std::vector<T>& v) {
    std::uint64_t size = 0;
    (*this)(size);
    if (size > bytes_.size() - at_) throw std::runtime_error("snapshot: a length is wrong");
    v.resize(size);
    for (T& x : v) (*this)(x);
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const unsigned char> bytes_;
  std::size_t at_ = 0;
};

template <class A, class T, int R, int C, int O>
void visit(A& archive, Eigen::Matrix<T, R, C, O>& m) {
  for (Eigen::Index k = 0; k < m.size(); ++k) archive(m.data()[k]);
}

template <class A, int Dim>
void visit(A& archive, State<double, Dim>& s) {
  visit(archive, s.strain);
  visit(archive, s.stress);
  archive(s.cracked);
  visit(archive, s.frame);
  visit(archive, s.crack.traction);
  visit(archive, s.crack.jump);
  visit(archive, s.crack.plastic_jump);
  visit(archive, s.crack.offset);
  archive(s.crack.slip);
  archive(s.crack.integrity);
  archive(s.crack.dissipated);
}

template <class A, std::size_t N>
void visit(A& archive, std::array<Field, N>& fields) {
  for (Field& f : fields) archive(f);
}

/// What defines the run, as bytes: a snapshot continues only the same run. Threads and instruction set do not matter.
template <int Dim>
std::uint64_t fingerprint(Scene<Dim> s) {
  Writer w;
  const auto put = [&](auto x) { w(x); };
  Options<Dim>& o = s.options;
  put(Dim);
  for (const int x : {static_cast<int>(s.setting), static_cast<int>(o.configuration), static_cast<int>(o.momentum),
                      static_cast<int>(o.kernel), static_cast<int>(o.rve_length.rule), static_cast<int>(o.method)}) {
    put(x);
  }
  const Parameters& p = s.parameters;
  for (const double x : {o.smoothing_ratio,
                         o.courant,
                         o.rve_length.value,
                         o.viscosity_alpha,
                         o.viscosity_beta,
                         o.artificial_stress,
                         o.skin,
                         o.zero_energy_control,
                         o.damping,
                         o.mass_scale,
                         o.release_integrity,
                         p.young_modulus,
                         p.poisson_ratio,
                         p.density,
                         p.tensile_strength,
                         p.cohesion,
                         p.friction_angle_deg,
                         p.dilation_angle_deg,
                         p.delta0,
                         p.normal_stiffness,
                         p.shear_stiffness,
                         s.arrangement.spacing}) {
    put(x);
  }
  visit(w, o.gravity);
  for (auto& x : s.arrangement.position) visit(w, x);
  for (auto& x : s.velocity) visit(w, x);
  w(s.arrangement.volume);
  w(s.arrangement.group);
  for (auto& cut : s.arrangement.cuts) {
    for (auto& x : cut.corner) visit(w, x);
  }
  for (const Group<Dim>& g : s.groups) {
    put(g.elastic);
    for (const auto& m : g.motion) {
      put(m.has_value());
      put(m ? m->speed : 0.0);
      put(m ? m->ramp : 0.0);
    }
  }
  return fnv(w.bytes);
}

/// Everything that changes during a run. What follows from it (weights, flags, views) is made anew after reading.
template <class A, int Dim>
void visit(A& archive, detail::Engine<Dim>& e) {
  Particles<Dim>& p = e.particles;
  archive(e.steps);
  archive(e.started);
  archive(e.prescribed_work);
  archive(e.kinetic_start);
  archive(e.builds);
  archive(e.released);
  visit(archive, p.position);
  visit(archive, p.velocity);
  visit(archive, p.acceleration);
  visit(archive, p.predicted);
  visit(archive, p.stress);
  visit(archive, p.strain);
  visit(archive, p.correction);
  visit(archive, p.artificial);
  visit(archive, p.gradient);
  visit(archive, p.flux);
  visit(archive, p.rotation);
  archive(p.volume);
  archive(p.density);
  archive(p.kind);
  archive(p.length);
  archive(p.fracture);
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] == kind::cracked) visit(archive, p.point[i]);
  }
  archive(e.damping_work);
  archive(e.viscous_work);
  archive(e.artificial_work);
  archive(e.damping_next);
  visit(archive, e.viscous_force);
  visit(archive, e.artificial_force);
  archive(e.control_work);
  archive(e.control_next);
  visit(archive, e.built_at);
  archive(e.lists);
  for (auto& r : e.reaction) visit(archive, r);
  for (auto& v : e.group_velocity) visit(archive, v);
}

}  // namespace

template <int Dim>
std::vector<unsigned char> Simulation<Dim>::snapshot() const {
  Writer w;
  std::uint64_t head[3] = {magic, version, fingerprint(engine_->scene)};
  for (std::uint64_t& x : head) w(x);
  visit(w, *engine_);
  std::uint64_t sum = fnv(w.bytes);
  w(sum);
  return std::move(w.bytes);
}

template <int Dim>
void Simulation<Dim>::restore(std::span<const unsigned char> bytes) {
  constexpr std::size_t tail = sizeof(std::uint64_t);
  if (bytes.size() < 4 * tail) throw std::runtime_error("snapshot: too short");
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - tail, tail);
  if (sum != fnv(bytes.first(bytes.size() - tail))) throw std::runtime_error("snapshot: damaged (checksum)");
  Reader r(bytes.first(bytes.size() - tail));
  std::uint64_t head[3] = {};
  for (std::uint64_t& x : head) r(x);
  if (head[0] != magic) throw std::runtime_error("snapshot: not one of this program");
  if (head[1] != version) throw std::runtime_error("snapshot: of another version of the program");
  if (head[2] != fingerprint(engine_->scene)) throw std::runtime_error("snapshot: of another scene");
  visit(r, *engine_);
  if (r.left() != 0) throw std::runtime_error("snapshot: too long");
  engine_->remake_bonds();
}

template std::vector<unsigned char> Simulation<2>::snapshot() const;
template void Simulation<2>::restore(std::span<const unsigned char>);

}  // namespace fpz::sph
