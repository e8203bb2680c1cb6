#include "fpz/specimen/specimen.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "check_particles.hpp"
#include "fpz/energy.hpp"
#include "fpz/io/input_error.hpp"
#include "fpz/specimen/surface_shares.hpp"
#include "fpz/sph/area_vectors.hpp"
#include "gauge_kinds.hpp"
#include "interface_map.hpp"
#include "material_map.hpp"

namespace fpz::specimen {
namespace {

using io::InputError;

[[noreturn]] void fail(const Scene& scene, const std::string& what) { throw InputError(scene.file + ": " + what); }

/// Throws all of them, one a line, each with the name of the file.
void fail_if_any(const Scene& scene, const std::vector<std::string>& wrong) {
  if (wrong.empty()) return;
  std::string text;
  for (const std::string& w : wrong) text += (text.empty() ? "" : "\n" + scene.file + ": ") + w;
  fail(scene, text);
}

sph::Arrangement<2> place(const Scene& scene) {
  sph::Arrangement<2> a = scene.particles
                              ? read_particles(scene.particles->file, scene.spacing, scene.particles->notation)
                              : place_specimen(scene.body, scene.pattern, scene.spacing);
  for (std::size_t b = 0; b < scene.boundaries.size(); ++b) {
    const Boundary& boundary = scene.boundaries[b];
    const int group = static_cast<int>(b);
    if (!boundary.platen) {
      if (std::find(a.group.begin(), a.group.end(), group) == a.group.end()) {
        fail(scene, "boundary \"" + boundary.name + "\" has no \"at\", and no particle of the file has group " +
                        std::to_string(b));
      }
      continue;
    }
    try {
      for (const Platen& platen : platens_of(boundary)) place_platen(a, scene.body.shape, platen, group);
    } catch (const std::invalid_argument& e) {
      fail(scene, "boundary \"" + boundary.name + "\": " + e.what());
    }
  }
  return a;
}

/// Rotation that takes the frame of a particle's stored tensors to space.
Mat<double, 2, 2> to_space(const sph::Simulation<2>& run, std::size_t i, bool updated) {
  Mat<double, 2, 2> q = Mat<double, 2, 2>::Identity();
  if (updated) return q;
  const sph::Particles<2>& p = run.particles_now();
  q << p.rotation[0][i], -p.rotation[1][i], p.rotation[1][i], p.rotation[0][i];
  return q;
}

Mat<double, 2, 2> stress_in_space(const sph::Simulation<2>& run, std::size_t i, bool updated) {
  const Mat<double, 2, 2> q = to_space(run, i, updated);
  return q * to_matrix<double, 2>(run.particles_now().stress_of(i)) * q.transpose();
}

/// Threads that pay off: below some thousand particles each, waiting for each other costs more than it gains.
int worthwhile_threads(std::size_t particles) {
  const auto cores = static_cast<std::size_t>(std::max(1U, std::thread::hardware_concurrency()));
  return static_cast<int>(std::clamp(particles / 4000, std::size_t{1}, cores));
}

bool is_updated(const Specimen& s) { return s.setup.options.configuration == sph::Configuration::updated; }

/// On the surface, in the middle of the columns.
Point middle_of_foot(const Scene& scene, const Platen& platen) {
  Point sum = Point::Zero();
  double count = 0.0;
  for (const std::optional<Point>& foot : platen_feet(scene.body.shape, platen, scene.spacing)) {
    if (foot) sum += *foot, count += 1.0;
  }
  return sum / count;
}

/// The loads of the scene as forces on particles.
void add_loads(const Scene& scene, Specimen& s) {
  if (scene.loads.empty()) return;
  const sph::Arrangement<2>& a = s.setup.arrangement;
  std::vector<SurfacePiece> pieces;
  try {
    pieces = share_surface(scene.body, a, sph::area_vectors(s.setup));
  } catch (const std::invalid_argument& e) {
    fail(scene, e.what());
  }
  for (const SurfaceLoad& load : scene.loads) {
    const std::vector<double> part = loaded_parts(scene.body, load.on, pieces, scene.spacing);
    double length = 0.0;
    for (std::size_t k = 0; k < pieces.size(); ++k) length += pieces[k].covered ? 0.0 : part[k] * pieces[k].length();
    if (!(length > 0.0)) {
      fail(scene, "load \"" + load.name + "\": there is no free surface where it acts (\"on\")");
    }
    const auto traction = [&](const SurfacePiece& piece) { return load.direction ? *load.direction : -piece.normal; };
    s.setup.loads.push_back({load.name, forces_of(pieces, a.size(), traction, part), load.course.starting(0.0, 0.0)});
    s.loaded_lengths.push_back(length);
  }
}

}  // namespace

SlotOfParticles slot_of_particles(const Notch& notch, const sph::Arrangement<2>& particles, double spacing) {
  const double none = std::numeric_limits<double>::infinity();
  const double length = (notch.tip - notch.mouth).norm();
  double left = none, right = none, beyond = none, behind = -none;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Point x = particles.position[i] - notch.mouth;
    const double s = along(notch).dot(x), d = across(notch).dot(x);
    const double half = 0.5 * particles.volume[i] / spacing;  // of its cell
    if (s > 0.0 && s < length) (d > 0.0 ? left : right) = std::min(d > 0.0 ? left : right, std::abs(d) - half);
    if (std::abs(d) >= 0.5 * std::max(notch.width, spacing)) continue;
    if (s >= length - spacing) beyond = std::min(beyond, s - half);
    if (s <= spacing) behind = std::max(behind, s + half);
  }
  const auto known = [](double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::quiet_NaN(); };
  return {known(left + right), known(notch.internal ? beyond - behind : beyond)};
}

Specimen make_specimen(const Scene& scene) {
  Specimen s;
  try {
    s.setup.arrangement = place(scene);
  } catch (const std::invalid_argument& e) {
    fail(scene, e.what());
  }
  for (const Notch& n : scene.body.notches) {
    sph::Cut<2> cut = cut_in(scene.body, n, scene.spacing);
    cut.friction = std::tan(degree * n.friction_angle_deg.value_or(
                                         detail::parameters_at(scene, 0.5 * (n.mouth + n.tip)).friction_angle_deg));
    s.setup.arrangement.cuts.push_back(cut);
  }
  if (!scene.particles) s.setup.arrangement.surface = surface_lines(scene.body, 0.25 * scene.spacing);
  const sph::Arrangement<2>& a = s.setup.arrangement;
  for (const Notch& n : scene.body.notches) {
    const SlotOfParticles as_asked{0.0, (n.tip - n.mouth).norm()};
    s.slots.push_back(n.width > 0.0 ? slot_of_particles(n, a, scene.spacing) : as_asked);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.group[i] == sph::Arrangement<2>::specimen) s.area += a.volume[i];
  }
  for (const Boundary& b : scene.boundaries) {
    sph::Group<2> group;
    group.name = b.name;
    for (std::size_t c = 0; c < 2; ++c) {
      if (b.drive[c]) group.drive[c] = b.drive[c]->starting(0.0, 0.0, 0.0, scene.thickness);
      // Under no force, but with one velocity.
      if (b.rigid && !b.drive[c]) group.drive[c] = sph::Drive(sph::Drive::Kind::force, sph::TimeTable::constant(0.0));
    }
    group.elastic = b.elastic;
    group.keeps_to_itself = true;
    if (b.platen && b.platen->friction) {
      group.bonded = false;
      for (const Platen& platen : platens_of(b)) {
        for (const sph::Cut<2>& cut : contact_of(scene.body.shape, platen, scene.spacing)) {
          s.setup.arrangement.cuts.push_back(cut);
        }
      }
    }
    if (b.hinged) group.hinge = b.hinge ? *b.hinge : middle_of_foot(scene, *b.platen);
    s.setup.groups.push_back(group);
  }
  s.setup.parameters = scene.parameters;
  try {
    detail::assign_materials(scene, s.setup);
    detail::assign_interfaces(scene, s.setup);
    if (scene.strength_field) s.setup.materials.strength_factor = strength_factors(*scene.strength_field, a.position);
  } catch (const std::invalid_argument& e) {
    fail(scene, e.what());
  }
  s.setup.setting = scene.setting;
  if (scene.initial_stress) s.setup.initial_stress = *scene.initial_stress;
  s.setup.options = scene.options;
  for (const Stage& stage : scene.stages) {
    s.setup.most_damping = std::max(s.setup.most_damping, stage.damping.value_or(0.0));
  }
  if (scene.solver.kind == Solver::Kind::relaxation) {
    s.setup.most_damping = std::max(s.setup.most_damping, scene.solver.rest_damping);
  }
  if (scene.options.threads == 0) s.setup.options.threads = worthwhile_threads(a.size());
  add_loads(scene, s);
  fail_if_any(scene, problems(s.setup));
  detail::ParticleFindings found = detail::check_particles(scene, a);
  fail_if_any(scene, found.problems);
  s.warnings = std::move(found.warnings);
  for (const auto& [name, gauge] : scene.gauges) {
    const detail::GaugeBinding to{scene, a, name};
    s.gauges.emplace(name, std::visit([&](const auto& kind) { return detail::bind(kind, to); }, gauge));
  }
  return s;
}

double mean_fracture_energy(const sph::Simulation<2>& run, const Specimen& specimen) {
  const sph::Particles<2>& p = run.particles_now();
  const auto energy = [](const Parameters& m) { return m.tensile_strength * m.delta0; };
  const auto parameters = [&](std::size_t i) {
    const sph::RunSetup<2>& s = specimen.setup;
    if (!run.cracked_on_weak_plane(i)) return parameters_of_particle(s, p.id[i]);
    return s.weak_planes.parameters[static_cast<std::size_t>(s.weak_planes.of_particle[p.id[i]])];
  };
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] != sph::kind::cracked) continue;
    const double opened = p.volume[i] * (1.0 - p.point[i].crack.integrity);
    sum += opened * energy(parameters(i)), weight += opened;
  }
  return weight > 0.0 ? sum / weight : energy(specimen.setup.parameters);
}

double largest_opening(const sph::Simulation<2>& run) {
  const sph::Particles<2>& p = run.particles_now();
  double most = std::nan("");
  for (std::size_t i = 0; i < p.count; ++i) {
    if (p.kind[i] == sph::kind::cracked) most = std::fmax(most, p.point[i].crack.jump.norm());
  }
  return most;
}

std::vector<Spot> spots(const sph::Simulation<2>& run, const Specimen& specimen) {
  const sph::Particles<2>& p = run.particles_now();
  const sph::Arrangement<2>& a = specimen.setup.arrangement;
  std::vector<Spot> all;
  for (std::size_t id = 0; id < a.size(); ++id) {
    if (a.group[id] != sph::Arrangement<2>::specimen) continue;
    const std::size_t i = run.slot(id);
    Spot s{a.position[id], a.volume[id], 0.0, Point(1.0, 0.0)};
    if (p.kind[i] == sph::kind::cracked) {
      s.damage = 1.0 - p.point[i].crack.integrity;
      s.normal = Point(p.point[i].frame(0, 0), p.point[i].frame(0, 1));
    }
    all.push_back(s);
  }
  return all;
}

PointCloud frame_of(const sph::Simulation<2>& run, const Specimen& specimen) {
  const sph::Particles<2>& p = run.particles_now();
  const sph::Arrangement<2>& a = specimen.setup.arrangement;
  std::vector<Elasticity<double>> bulk;
  for (std::size_t k = 0; k < specimen.setup.materials.count(); ++k) {
    bulk.push_back(make_material(parameters_of(specimen.setup, k), specimen.setup.setting).bulk);
  }
  const bool updated = is_updated(specimen);
  PointCloud cloud;
  cloud.time = run.loading_time();
  const auto add = [&](const char* name, int components, bool single = true) -> std::vector<double>& {
    cloud.data.push_back({name, components, {}, single});
    cloud.data.back().values.reserve(a.size() * static_cast<std::size_t>(components));
    return cloud.data.back().values;
  };
  cloud.data.reserve(16);
  auto& group = add("group", 1);
  auto& volume = add("volume", 1);
  auto& damage = add("damage", 1);
  auto& normal = add("crack_normal", 3);
  auto& jump = add("jump", 3);
  auto& sxx = add("stress_xx", 1);
  auto& syy = add("stress_yy", 1);
  auto& sxy = add("stress_xy", 1);
  auto& velocity = add("velocity", 3);
  auto& displacement = add("displacement", 3, false);
  auto& elastic = add("elastic_energy", 1);
  auto& dissipated = add("dissipated_energy", 1);
  auto& length = add("rve_length", 1);
  const auto vector = [](std::vector<double>& values, double x, double y) { values.insert(values.end(), {x, y, 0.0}); };
  for (std::size_t id = 0; id < a.size(); ++id) {
    const std::size_t i = run.slot(id);
    const bool cracked = p.kind[i] == sph::kind::cracked;
    const Mat<double, 2, 2> q = to_space(run, i, updated);
    const Mat<double, 2, 2> stress = stress_in_space(run, i, updated);
    vector(cloud.points, p.position[0][i], p.position[1][i]);
    group.push_back(a.group[id]);
    volume.push_back(a.volume[id]);
    damage.push_back(cracked ? 1.0 - p.point[i].crack.integrity : 0.0);
    const Mat<double, 2, 2> axes =
        cracked ? Mat<double, 2, 2>(q * p.point[i].frame.transpose()) : Mat<double, 2, 2>(Mat<double, 2, 2>::Zero());
    vector(normal, axes(0, 0), axes(1, 0));
    const Point opening = cracked ? Point(axes * p.point[i].crack.jump) : Point(0.0, 0.0);
    vector(jump, opening[0], opening[1]);
    sxx.push_back(stress(0, 0));
    syy.push_back(stress(1, 1));
    sxy.push_back(stress(0, 1));
    vector(velocity, p.velocity[0][i], p.velocity[1][i]);
    vector(displacement, p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]);
    Tensor<double, 2> components;
    components << stress(0, 0), stress(1, 1), stress(0, 1);
    elastic.push_back(elastic_energy<2>(bulk[specimen.setup.materials.of(id)], components, 1.0));
    dissipated.push_back(cracked ? p.point[i].crack.dissipated : 0.0);
    length.push_back(cracked ? p.length[i] : 0.0);
  }
  const std::vector<int>& interfaces = specimen.setup.weak_planes.of_particle;
  if (!interfaces.empty()) {
    auto& interface = add("interface", 1);
    for (const int k : interfaces) interface.push_back(k + 1);
  }
  if (const auto& strength = specimen.setup.materials.strength_factor; !strength.empty()) {
    add("strength_factor", 1) = strength;
  }
  if (bulk.size() > 1) {
    auto& material = add("material", 1);
    for (std::size_t id = 0; id < a.size(); ++id)
      material.push_back(static_cast<double>(specimen.setup.materials.of(id)));
  }
  return cloud;
}

double frame_bytes(std::size_t particles) {
  constexpr double wide = 6.0 * 8.0, single = 18.0 * 4.0, cell = 17.0;  // bytes per particle
  return (wide + single + cell) * static_cast<double>(particles) + 3000.0;
}

}  // namespace fpz::specimen
