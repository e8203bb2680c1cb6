// The method before and after: plain kernel gradients without zero-energy control and the published zone, against the
// defaults, on specimens with a known answer.
#include <algorithm>
#include <cmath>

#include "fpz/specimen/geometry.hpp"
#include "notched_reference.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

constexpr const char* sides[] = {"before", "after"};

/// Width of a polygon at its waist, which is symmetric about x = 0, m.
double waist(const specimen::Scene& scene) {
  const auto* polygon = std::get_if<specimen::Polygon>(&scene.body.shape);
  if (polygon == nullptr) return NAN;
  double half = HUGE_VAL;
  for (const specimen::Point& c : polygon->corners) half = std::min(half, std::abs(c[0]));
  return 2.0 * half;
}

std::size_t crack_count(const Run& run) {
  const io::JsonValue* cracks = run.summary.find("cracks");
  return cracks != nullptr ? cracks->items.size() : 0;
}

/// Dissipated by fracture over G times an area that is not the program's own, m^2.
double true_ratio(const Run& run, double area) {
  return run.figure("energies/fracture") / (run.figure("fracture_energy_G") * area);
}

/// One row per arrangement and side, in the order of the sweep.
template <class Cells>
void compare(std::ostream& out, const SweepRuns& sweep, Row header, const Cells& cells) {
  std::vector<Row> rows;
  std::vector<std::string> labels;
  for (const Run& run : sweep.runs) {
    if (std::find(labels.begin(), labels.end(), run.label) == labels.end()) labels.push_back(run.label);
  }
  for (const std::string& label : labels) {
    for (const char* side : sides) {
      const Run* run = sweep.find(side, label);
      if (run == nullptr) continue;
      Row row = {label, side};
      for (std::string& cell : cells(*run)) row.push_back(std::move(cell));
      row.emplace_back(run->finished() ? "" : "failed");
      rows.push_back(std::move(row));
    }
  }
  header.insert(header.begin(), {"", "method"});
  header.emplace_back("");
  write_table(out, header, rows);
}

void dogbone(std::ostream& out, const SweepRuns& sweep, const Gallery& gallery) {
  if (!write_state(out, sweep, "the dog-bone")) return;
  out << "### Dog-bone in tension\n\nOne crack through the waist is right; its energy is G times the ligament.\n\n";
  compare(out, sweep, {"peak, N", "cracks", "energy / (ligament G)", "balance error"}, [](const Run& run) {
    const specimen::Scene scene = run.parsed_scene();
    return Row{fixed(run.figure("peak_load"), 0), std::to_string(crack_count(run)),
               fixed(true_ratio(run, waist(scene) * scene.thickness), 3),
               percent(run.figure("energy_balance_error"), 2)};
  });
  std::vector<CrackMap> maps;
  for (const Run& run : sweep.runs) {
    const auto frames = run.frames();
    if (!frames.empty()) maps.push_back(crack_map(run, frames.back(), run.series + ", " + run.label));
  }
  if (!maps.empty()) {
    out << "\n"
        << gallery.show(crack_picture("dogbone", maps, 4), "dogbone", "Cracked particles of the dog-bone at the end")
        << "\n";
  }
}

/// Load of the first shear plane in uniaxial compression without friction at the platens, N: on the Mohr circle with
/// p = -r, sqrt(r^2 + A^2) = c0 cos(phi) - p sin(phi) gives r = (c0 sin(phi) + sqrt(c0^2 - A^2)) / cos(phi).
double compressive_load(const Run& run) {
  const double phi = degree * run.setting("material/friction_angle_deg");
  const double c0 = run.setting("material/cohesion");
  const double a = c0 - run.setting("material/tensile_strength") * std::tan(phi);
  const double r = (c0 * std::sin(phi) + std::sqrt(c0 * c0 - a * a)) / std::cos(phi);
  const double width = run.setting("shape/high/0") - run.setting("shape/low/0");
  return 2.0 * r * width * run.setting("thickness");
}

void compression(std::ostream& out, const SweepRuns& sweep) {
  if (!write_state(out, sweep, "uniaxial compression")) return;
  out << "### Uniaxial compression\n\nThe closed form is the load of the first shear plane under even stress; bonded "
         "platens raise the stress at their edges, so that a peak below it is expected.\n\n";
  compare(out, sweep,
          {"peak, kN", "closed form, kN", "(kinetic + viscous) / work", "elastic at the end, J",
           "fracture at the end, J", "balance error"},
          [](const Run& run) {
            const double motion = run.figure("energies/kinetic") + run.figure("energies/viscous");
            return Row{
                fixed(1e-3 * run.figure("peak_load"), 1),           fixed(1e-3 * compressive_load(run), 1),
                fixed(motion / run.figure("energies/external"), 2), fixed(run.figure("energies/elastic"), 2),
                fixed(run.figure("energies/fracture"), 2),          percent(run.figure("energy_balance_error"), 2)};
          });
}

void disc(std::ostream& out, const SweepRuns& sweep) {
  if (!write_state(out, sweep, "the solid disc")) return;
  out << "### Solid disc under diametral load\n\nWith nothing but tension governing, the first crack belongs at `pi/2 "
         "sigma_t0 D t` of the closed form for line loads.\n\n";
  compare(out, sweep, {"first crack, kN", "closed form, kN", "", "at x, y, mm", "peak, kN"}, [](const Run& run) {
    const double closed =
        M_PI * run.setting("material/tensile_strength") * run.setting("shape/radius") * run.setting("thickness");
    const auto crack = first_crack(run);
    return Row{crack ? fixed(1e-3 * crack->load, 2) : "none", fixed(1e-3 * closed, 2),
               crack ? deviation(crack->load / closed - 1.0) : "-",
               crack ? fixed(1e3 * crack->at[0], 1) + ", " + fixed(1e3 * crack->at[1], 1) : "-",
               fixed(1e-3 * run.figure("peak_load"), 2)};
  });
}

/// From the end of its notch to the other side, m.
double ligament(const specimen::Scene& scene) {
  const specimen::Point tip = scene.body.notches.front().tip;
  return specimen::extent(scene.body.shape).second[1] - tip[1];
}

void beam(std::ostream& out, const SweepRuns& sweep) {
  if (!write_state(out, sweep, "the beam on other arrangements")) return;
  out << "### Notched beam on any arrangement\n\nAgainst finite elements with pressures over the width of the rollers. "
         "The energy is divided by G times the ligament, not by the program's own crack.\n\n";
  compare(out, sweep, {"peak, N", "against FE", "energy / (ligament G)", "of its own crack"}, [](const Run& run) {
    const specimen::Scene scene = run.parsed_scene();
    return Row{fixed(run.figure("peak_load"), 0), deviation(beam_errors(run).peak),
               fixed(true_ratio(run, ligament(scene) * scene.thickness), 3),
               fixed(run.figure("fracture_energy_ratio"), 3)};
  });
}

}  // namespace

void write_method(std::ostream& out, const Results& results, const Gallery& gallery) {
  out << "## 4. The method, before and after\n\nBefore: gradients of the kernel, no zero-energy control, the published "
         "zone, no bonds cut. After: the defaults ([method.md](method.md) says why).\n\n";
  dogbone(out, results.method_dogbone, gallery);
  out << "\n";
  compression(out, results.method_compression);
  out << "\n";
  disc(out, results.method_disc);
  out << "\n";
  beam(out, results.method_beam);
}

}  // namespace fpz::report
