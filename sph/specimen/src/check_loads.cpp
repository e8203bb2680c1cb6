// Sizes of pressures, tractions and forces: numbers that would be usual in another unit.
#include "check_scene.hpp"
#include "fpz/io/plausibility.hpp"

namespace fpz::specimen::detail {
namespace {

/// Small loads are no mistake by themselves; one that is far off, and usual in another unit, hardly was meant.
void judge_load(const SceneCheck& c, const Place& stated, std::string_view what, double si,
                const io::Typical& typical) {
  if (si == 0.0) return;
  const io::Judgement j = io::judge(what, {si, si, io::si_unit(typical.quantity)}, typical, io::Spelling::si_only);
  if (j.verdict != io::Verdict::impossible || !j.other_unit) return;
  at_member(stated, "value", [&](const Place& p) { c.warnings.push_back(c.reader.where(p) + ": " + j.text); });
}

void judge_force(const SceneCheck& c, const Place& boundary, const Boundary& b) {
  const auto [low, high] = extent(c.scene.body.shape);
  const double section = c.scene.thickness * (high - low).minCoeff();
  const io::Typical typical = io::scaled(io::typical::tensile_stress, io::Quantity::force, 1.0 / section);
  with(boundary, "force", [&](const Place& force) {
    for (std::size_t k = 0; k < 2; ++k) {
      with(force, component_names[k],
           [&](const Place& p) { judge_load(c, p, "force", b.drive[k]->course.largest(), typical); });
    }
  });
}

}  // namespace

void check_loads(const SceneCheck& c) {
  for_entries(c, "loads", [&](const Place& load, std::size_t k) {
    for (const char* key : {"pressure", "traction"}) {
      with(load, key,
           [&](const Place& p) { judge_load(c, p, key, c.scene.loads[k].course.largest(), io::typical::pressure); });
    }
  });
  for_entries(c, "boundaries", [&](const Place& p, std::size_t k) { judge_force(c, p, c.scene.boundaries[k]); });
}

}  // namespace fpz::specimen::detail
