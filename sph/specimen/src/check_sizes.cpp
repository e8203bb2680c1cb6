// Thickness, size and weight of the body; the spacing against its narrowest part and the process zone.
#include <cmath>
#include <optional>

#include "check_scene.hpp"
#include "fpz/io/plausibility.hpp"
#include "ligament.hpp"

namespace fpz::specimen::detail {
namespace {

void judge_length(const SceneCheck& c, const Place& at, const char* what, double metres, const io::Typical& typical) {
  const io::Judgement j = io::judge(what, {metres, metres, "m"}, typical, io::Spelling::si_only);
  if (j.verdict == io::Verdict::impossible) c.reader.problem(at, j.text);
  if (j.verdict == io::Verdict::doubtful) c.warnings.push_back(c.reader.where(at) + ": " + j.text);
}

void check_body_size(const SceneCheck& c) {
  const auto [low, high] = extent(c.scene.body.shape);
  const Point size = high - low;
  with(c.root, "shape", [&](const Place& p) {
    judge_length(c, p, "the size of the body", size.maxCoeff(), io::typical::specimen_size);
  });
}

/// A spacing in micrometres asks for more particles than any machine has room for.
void check_count(const SceneCheck& c) {
  constexpr double many = 5e6, most = 2e8;
  const double count = area(c.scene.body) / (c.scene.spacing * c.scene.spacing);
  if (count < many) return;
  with(c.root, "spacing", [&](const Place& p) {
    const std::string text = "makes about " + brief(count) + " particles of the body";
    count > most ? c.problem(p, text + "; must be >= " + brief(std::sqrt(area(c.scene.body) / most))) : c.warn(p, text);
  });
}

/// The body with cuts in place of slots that would leave nothing of it: with a spacing that is far too large.
Body with_possible_slots(Body body) {
  const auto [low, high] = extent(body.shape);
  for (Notch& n : body.notches) {
    if (n.width > 0.5 * (high - low).minCoeff()) n.width = 0.0;
  }
  return body;
}

/// The notch at whose end a neck is that is short beside the notch, where there is one.
std::optional<std::size_t> notch_at_neck(const std::vector<Notch>& notches, const Ligament& l) {
  constexpr double part = 0.25;
  for (std::size_t k = 0; k < notches.size(); ++k) {
    const Notch& n = notches[k];
    if ((l.from == n.tip || l.to == n.tip) && l.width < part * (n.tip - n.mouth).norm()) return k;
  }
  return std::nullopt;
}

/// A bridge of less than three rows before the end of a notch: it was meant to end on the surface, or well before it.
void refuse_bridge(const SceneCheck& c, std::size_t k, const Ligament& l) {
  const Notch& n = c.scene.body.notches[k];
  const double length = (n.tip - n.mouth).norm();
  with(c.root, "notches", [&](const Place& notches) {
    with(Place(notches, notches.value().items[k]), "length", [&](const Place& p) {
      c.problem(p, "the notch ends " + brief(l.width) + " m (" + brief(l.width / c.scene.spacing) +
                       " spacings) before the surface or another notch at " + brief(l.from == n.tip ? l.to : l.from) +
                       ", and particles cannot show a bridge of less than 3 rows; must reach through it, " +
                       brief(length + l.width) + ", or leave it 3 rows, with a smaller \"spacing\" or <= " +
                       brief(length + l.width - 3.0 * c.scene.spacing));
    });
  });
}

/// A neck of a few rows is all surface, and its stress a matter of chance.
void check_necks(const SceneCheck& c) {
  constexpr double fewest = 3.0, enough = 10.0;
  const Ligament l = smallest_ligament(with_possible_slots(c.scene.body));
  const double rows = l.width / c.scene.spacing;
  if (!std::isfinite(rows) || rows >= enough * (1.0 - 1e-6)) return;
  if (const auto k = notch_at_neck(c.scene.body.notches, l); k && rows < fewest) return refuse_bridge(c, *k, l);
  with(c.root, "spacing", [&](const Place& p) {
    std::string text = "only " + brief(rows) + " rows of particles across the narrowest part of the body, " +
                       brief(l.width) + " m from " + brief(l.from) + " to " + brief(l.to) + "; ";
    text += rows < fewest ? "must be <= " + brief(l.width / fewest) + " (3 rows), and should be <= " : "should be <= ";
    text += brief(l.width / enough) + " (10 rows)";
    if (rows >= fewest) return c.warn(p, text);
    c.problem(p, text + likely_length(c.scene.spacing, 1e-3 * l.width, l.width / enough));
  });
}

/// A mesh of particles cannot follow a process zone that is a few spacings long, and not even begin where H snaps back.
void check_process_zone(const SceneCheck& c, const Place& root, std::string_view key, const Parameters& p) {
  constexpr double least_spacings = 5.0;
  const double confined = c.scene.setting == Setting::plane_strain ? 1.0 - p.poisson_ratio * p.poisson_ratio : 1.0;
  const double zone = p.young_modulus / confined * p.delta0 / p.tensile_strength;  // E G / sigma_t0^2
  const double longest = snap_back_length(p, c.scene.setting);
  const std::string spacing = key == "spacing" ? "" : "the spacing, " + brief(c.scene.spacing) + ", ";
  const std::string is = spacing.empty() ? "" : "is ";
  with(root, key, [&](const Place& at) {
    if (c.scene.spacing >= longest) {
      return c.warn(at, spacing + "should be < " + brief(longest) +
                            ", the longest H without snap-back of this material: a run ends where the first particle "
                            "cracks");
    }
    if (zone >= least_spacings * c.scene.spacing) return;
    c.warn(at, spacing + is +
                   "too coarse for this material, whose process zone is about E G / sigma_t0^2 = " + brief(zone) +
                   " m long; peak loads then depend on the spacing (at most " + brief(zone / least_spacings) + ")");
  });
}

/// Gravity that tears the body by its weight is one in other units.
void check_gravity(const SceneCheck& c) {
  const auto [low, high] = extent(c.scene.body.shape);
  const double stress = c.scene.parameters.density * c.scene.options.gravity.norm() * (high - low).maxCoeff();
  if (stress < c.scene.parameters.tensile_strength) return;
  with(c.root, "method", [&](const Place& method) {
    with(method, "gravity", [&](const Place& p) {
      c.warn(p, "the weight of the body alone makes stresses of " + brief(1e-6 * stress) +
                    " MPa, above its tensile strength (on earth: 9.81 m/s^2)");
    });
  });
}

}  // namespace

void check_sizes(const SceneCheck& c) {
  with(c.root, "thickness",
       [&](const Place& p) { judge_length(c, p, "thickness", c.scene.thickness, io::typical::small_size); });
  check_body_size(c);
  check_gravity(c);
  check_count(c);
}

void check_rows(const SceneCheck& c) {
  const std::size_t before = c.reader.problems().size();
  check_necks(c);
  if (c.reader.problems().size() != before) return;
  check_process_zone(c, c.root, "spacing", c.scene.parameters);
  for_entries(c, "regions", [&](const Place& p, std::size_t k) {
    const std::size_t number = c.scene.regions[k].material;
    check_process_zone(c, p, "material", c.scene.further_materials[number - 1].parameters);
  });
  for_entries(c, "interfaces", [&](const Place& p, std::size_t k) {
    check_process_zone(c, p, "material", c.scene.interfaces[k].material);
  });
}

}  // namespace fpz::specimen::detail
