// What a run writes, and how often.
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::array<std::string_view, 6> output_keys = {"history_rows",       "frames",  "frames_at", "picture_loads",
                                                         "checkpoint_seconds", "pictures"};

}  // namespace

void read_output(const InputReader& r, const Place& place, OutputRules& o) {
  if (!r.object(place, "output choices")) return;
  r.known_keys(place, output_keys);
  with(place, "history_rows", [&](const Place& p) { o.history_rows = r.integer(p, 10, 1'000'000).value_or(1000); });
  with(place, "frames", [&](const Place& p) { o.frames = r.integer(p, 0, 100'000).value_or(0); });
  with(place, "checkpoint_seconds", [&](const Place& p) { o.checkpoint_seconds = not_negative(r, p).value_or(60.0); });
  with(place, "pictures", [&](const Place& p) { o.pictures = boolean(r, p).value_or(true); });
  const auto list = [&](std::string_view key, double low, double high, std::vector<double>& values) {
    with(place, key, [&](const Place& p) {
      if (!p.value().is(JsonValue::Kind::array)) return r.problem(p, "expected an array of numbers");
      values.clear();
      for (const JsonValue& item : p.value().items) {
        if (const auto x = r.number_between(Place(p, item), low, high, true)) values.push_back(*x);
      }
    });
  };
  list("frames_at", 0.0, 1e6, o.frames_at);
  list("picture_loads", -1.0, 1.0, o.picture_loads);
}

}  // namespace fpz::specimen::detail
