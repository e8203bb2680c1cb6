// The method before and after: plain kernel gradients without zero-energy control and the published zone, against the
// defaults, on specimens with a known answer.
#include <algorithm>
#include <cmath>

#include "fpz/io/csv.hpp"
#include "fpz/specimen/geometry.hpp"
#include "notched_reference.hpp"
#include "sections.hpp"
#include "text.hpp"

namespace fpz::report {
namespace {

constexpr const char* sides[] = {"before", "after", "after at 2.667 mm", "after at 2 mm"};  // series of the sweeps

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

/// Work of a dog-bone's load over that of an elastic body of its stiffness in series with one cohesive zone across the
/// waist, whose load is P = sigma_t0 A exp(-(u - P/K)/delta0) once it has reached sigma_t0 A.
double work_of_one_crack(const Run& run, double area) {
  const double strength = run.setting("material/tensile_strength") * area, length = run.setting("material/delta0");
  const double stiffness = run.figure("stiffness");
  const auto load_at = [&](double u) {
    double low = 0.0, high = strength;
    if (stiffness * u < high) return stiffness * u;
    for (int k = 0; k < 60; ++k) {
      const double load = 0.5 * (low + high);
      (load < strength * std::exp(-(u - load / stiffness) / length) ? low : high) = load;
    }
    return low;
  };
  const io::Table t = run.history();
  const std::vector<double>&way = t.at("deflection"), &load = t.at("load");
  double work = 0.0, closed = 0.0;
  for (std::size_t k = 1; k < load.size(); ++k) {
    work += 0.5 * (load[k] + load[k - 1]) * (way[k] - way[k - 1]);
    closed += 0.5 * (load_at(way[k]) + load_at(way[k - 1])) * (way[k] - way[k - 1]);
  }
  return work / closed;
}

void dogbone(std::ostream& out, const SweepRuns& sweep, const Gallery& gallery) {
  if (!write_state(out, sweep, "the dog-bone")) return;
  out << "### Dog-bone in tension\n\nOne crack through the waist is right. The work is that of the grips, against "
         "an elastic body in series with one cohesive zone across the waist, at the same displacements.\n\n";
  compare(out, sweep, {"peak, N", "cracks", "work against closed form", "balance error"}, [](const Run& run) {
    const specimen::Scene scene = run.parsed_scene();
    return Row{fixed(run.figure("peak_load"), 0), std::to_string(crack_count(run)),
               deviation(work_of_one_crack(run, waist(scene) * scene.thickness) - 1.0),
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

/// Largest distance of the crack from the line of an upright notch, m, from its tip through three quarters of the
/// height.
double straying(const Run& run) {
  const specimen::Scene scene = run.parsed_scene();
  const specimen::Point tip = scene.body.notches.front().tip;
  const double top = 0.75 * specimen::extent(scene.body.shape).second[1];
  const io::Table path = io::read_csv(run.folder / "crack.csv");
  double most = 0.0;
  for (std::size_t k = 0; k < path.at("crack").size(); ++k) {
    const specimen::Point p(path.at("x")[k], path.at("y")[k]);
    if (path.at("crack")[k] == 0.0 && p[1] > tip[1] && p[1] < top) most = std::max(most, std::abs(p[0] - tip[0]));
  }
  return most;
}

/// How far the peaks of a series are from finite elements and from one another.
void scatter_of_peaks(std::ostream& out, const SweepRuns& sweep) {
  std::vector<std::string> names;
  for (const Run& run : sweep.runs) {
    if (std::find(names.begin(), names.end(), run.series) == names.end()) names.push_back(run.series);
  }
  std::vector<Row> rows;
  for (const std::string& name : names) {
    const std::vector<const Run*> runs = sweep.of(name);
    double sum = 0.0, squares = 0.0, low = INFINITY, high = -INFINITY;
    for (const Run* run : runs) {
      const double error = beam_errors(*run).peak;
      sum += error, squares += error * error;
      low = std::min(low, error), high = std::max(high, error);
    }
    const auto n = static_cast<double>(runs.size());
    const double mean = sum / n;
    rows.push_back({name, fixed(n, 0), deviation(low), deviation(high), deviation(mean),
                    percent(n > 1.0 ? std::sqrt((squares - n * mean * mean) / (n - 1.0)) : NAN)});
  }
  out << "\nPeaks against finite elements, over all arrangements:\n";
  write_table(out, {"method", "runs", "lowest", "highest", "mean", "standard deviation"}, rows);
}

void beam(std::ostream& out, const SweepRuns& sweep) {
  if (!write_state(out, sweep, "the beam on other arrangements")) return;
  out << "### Notched beam on any arrangement\n\nAgainst finite elements with pressures over the width of the rollers; "
         "the work is that of the load at half depth, to the deflection that both reach. Path: how far the crack "
         "strays from the line of the notch in the lower three quarters of the beam.\n\n";
  compare(out, sweep, {"peak, N", "against FE", "work against FE", "path, mm"}, [](const Run& run) {
    const BeamErrors errors = beam_errors(run);
    return Row{fixed(run.figure("peak_load"), 0), deviation(errors.peak), deviation(errors.work),
               fixed(1e3 * straying(run), 1)};
  });
  scatter_of_peaks(out, sweep);
}

}  // namespace

void write_method(std::ostream& out, const Results& results, const Gallery& gallery) {
  out << "## 4. The method, before and after\n\nBefore: gradients of the kernel, no zero-energy control, the published "
         "zone, no bonds cut; H, tips and volumes as now. After: the defaults ([method.md](method.md) says why).\n\n";
  dogbone(out, results.method_dogbone, gallery);
  out << "\n";
  compression(out, results.method_compression);
  out << "\n";
  disc(out, results.method_disc);
  out << "\n";
  beam(out, results.method_beam);
}

}  // namespace fpz::report
