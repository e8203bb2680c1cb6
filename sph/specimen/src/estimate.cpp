#include "fpz/specimen/estimate.hpp"

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <sstream>

#include "fpz/io/input_error.hpp"
#include "interface_map.hpp"
#include "material_map.hpp"

namespace fpz::specimen {
namespace {

double seconds(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

/// Steps until the fastest boundary has moved as far as the deflection at which the run stops.
long long steps_to_deflection(const Scene& scene, double time_step) {
  double time = scene.stop.time;
  double speed = 0.0, ramp = 0.0;
  for (const Boundary& b : scene.boundaries) {
    for (const auto& a : b.drive) {
      if (!a || a->kind != sph::Drive::Kind::velocity || a->course.largest() <= speed) continue;
      speed = a->course.largest(), ramp = a->course.duration();
    }
  }
  if (scene.stop.deflection && speed > 0.0) time = std::min(time, *scene.stop.deflection / speed + 0.5 * ramp);
  return std::llround(std::ceil(time / time_step));
}

/// Slots as asked for and as their particles make them.
std::string slots_text(const Scene& scene, const Specimen& specimen) {
  std::ostringstream s;
  s.precision(3);
  for (std::size_t k = 0; k < specimen.slots.size(); ++k) {
    const Notch& n = scene.body.notches[k];
    if (n.asked_width <= 0.0) continue;
    if (n.width <= 0.0) {
      s << "  notch " << k << "           a cut: its " << 1e3 * n.asked_width << " mm are narrower than a spacing\n";
      continue;
    }
    s << "  notch " << k << "           " << 1e3 * specimen.slots[k].width << " mm wide, "
      << 1e3 * specimen.slots[k].length << " mm long by its particles (asked for " << 1e3 * n.width << " and "
      << 1e3 * (n.tip - n.mouth).norm() << ")\n";
  }
  return s.str();
}

/// Materials and how much of the body is of them; interfaces.
std::string materials_text(const Scene& scene, const Specimen& specimen) {
  std::ostringstream s;
  s.precision(4);
  const std::vector<std::size_t> count = detail::interface_particles(scene, specimen.setup);
  for (std::size_t k = 0; k < count.size(); ++k) {
    s << "  interface         " << scene.interfaces[k].name << ": " << count[k] << " particles beside it\n";
  }
  if (scene.further_materials.empty()) return s.str();
  for (const detail::MaterialShare& share : detail::material_shares(scene, specimen.setup)) {
    s << "  material          " << share.name << ": " << share.particles << " particles, " << 1e6 * share.area
      << " mm^2\n";
  }
  return s.str();
}

/// Loads and how much of the surface they act on.
std::string loads_text(const Scene& scene, const Specimen& specimen) {
  std::ostringstream s;
  s.precision(4);
  for (std::size_t k = 0; k < scene.loads.size(); ++k) {
    const SurfaceLoad& load = scene.loads[k];
    s << "  load              " << load.name << ": " << (load.direction ? "traction" : "pressure") << " on "
      << 1e3 * specimen.loaded_lengths[k] << " mm of the surface\n";
  }
  return s.str();
}

}  // namespace

Estimate estimate(const Scene& scene, const Specimen& specimen, int threads) {
  Specimen own = specimen;
  if (threads > 0) own.setup.options.threads = threads;
  sph::Simulation<2> run(own.setup);
  Estimate e;
  e.schedule = schedule_of(scene, run.time_step());
  const double pace = scene.solver.kind == Solver::Kind::dynamic ? scene.solver.pace : 1.0;
  e.most_steps = std::llround(static_cast<double>(e.schedule.steps) / pace);
  e.likely_steps = std::llround(static_cast<double>(steps_to_deflection(scene, run.time_step())) / pace);
  e.mean_neighbours = run.mean_neighbours();
  const auto step = [&] {
    if (const sph::Outcome o = run.step(); !o.ok())
      throw io::InputError(scene.name + ": the first steps fail: " + o.message());
  };
  for (int k = 0; k < 3; ++k) step();  // warm
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processor = std::clock();
  long long n = 0;
  while (seconds(start) < 0.5) {
    step();
    ++n;
  }
  e.step_seconds = seconds(start) / static_cast<double>(n);
  e.step_processor_seconds = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC / static_cast<double>(n);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  e.memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  e.disk = frame_bytes(run.count()) * (scene.output.frames + 6.0) + static_cast<double>(run.snapshot().size());
  return e;
}

std::string estimate_text(const Scene& scene, const Specimen& specimen, const Estimate& e) {
  const double count = static_cast<double>(specimen.setup.arrangement.size());
  std::ostringstream s;
  s.precision(3);
  s << "  particles         " << specimen.setup.arrangement.size() << " (" << e.mean_neighbours << " neighbours each)\n"
    << "  specimen area     " << 1e6 * specimen.area << " mm^2\n"
    << materials_text(scene, specimen) << slots_text(scene, specimen) << loads_text(scene, specimen)
    << "  time step         " << e.schedule.time_step << " s, row every " << e.schedule.row_every
    << " steps, frame every " << e.schedule.frame_every << "\n"
    << "  steps             at most " << e.most_steps;
  if (scene.stop.deflection && e.likely_steps < e.most_steps)
    s << ", about " << e.likely_steps << " to stop.deflection";
  s << "\n  speed             " << 1e-6 * count / e.step_seconds << " million particle-steps/s (uncracked)\n"
    << "  time              about " << e.step_seconds * static_cast<double>(e.likely_steps)
    << " s or less (cracked particles cost more; the load may drop earlier)\n"
    << "  memory            " << e.memory / 1048576.0 << " MiB\n"
    << "  disk              " << e.disk / 1048576.0 << " MiB\n"
    << "  gauges            ";
  for (const auto& [name, g] : specimen.gauges) s << name << " ";
  s << "\n";
  if (scene.solver.kind == Solver::Kind::dynamic && scene.solver.pace != 1.0) {
    s << "  solver            all speeds times " << scene.solver.pace << "\n";
  } else if (scene.solver.kind != Solver::Kind::dynamic) {
    s << "  solver            " << fpz::to_string(scene.solver.kind)
      << ": steps and time above are those at the speeds of the scene\n";
  }
  if (scene.options.damping > 0.0 || scene.options.mass_scale > 1.0) {
    s << "  note              damping " << scene.options.damping << ", mass_scale " << scene.options.mass_scale << "\n";
  }
  return s.str();
}

}  // namespace fpz::specimen
