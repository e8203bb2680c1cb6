// How a run ends against what is to be written.
#include "check_scene.hpp"

namespace fpz::specimen::detail {

void check_end(const SceneCheck& c) {
  if (!c.scene.stop.deflection) return;
  with(c.root, "output", [&](const Place& output) {
    with(output, "frames_at", [&](const Place& list) {
      for (const JsonValue& item : list.value().items) {
        if (item.number <= *c.scene.stop.deflection) continue;
        c.warn(Place(list, item),
               "never reached: the run ends at stop.deflection = " + brief(*c.scene.stop.deflection));
      }
    });
  });
}

}  // namespace fpz::specimen::detail
