// Quantities over time, and the components of a boundary that follow them.
#include <cmath>

#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

using Form = TimeCourse::Form;
using DriveKind = sph::Drive::Kind;

constexpr int most_cycles = 10'000;

void read_rise(const InputReader& r, const Place& p, std::string_view value_key, TimeCourse& c) {
  const std::array<std::string_view, 2> keys = {value_key, "ramp"};
  r.known_keys(p, keys);
  with_required(r, p, value_key, [&](const Place& q) { c.value = r.number(q).value_or(0.0); });
  with(p, "ramp", [&](const Place& q) { c.ramp = not_negative(r, q).value_or(0.0); });
}

/// One row [time, value].
void read_row(const InputReader& r, const Place& row, sph::TimeTable& table) {
  const auto pair = point(r, row);
  if (!pair) return;
  if (table.time.empty() && (*pair)[0] != 0.0) r.problem(row, "the first time of a table is 0: the begin of its stage");
  if (!table.time.empty() && !((*pair)[0] > table.time.back())) r.problem(row, "times must ascend");
  table.time.push_back((*pair)[0]);
  table.value.push_back((*pair)[1]);
}

/// The table again and again: it must come back to where it began.
void repeat(const InputReader& r, const Place& p, int cycles, sph::TimeTable& table) {
  if (cycles > 1 && table.value.front() != table.value.back()) {
    r.problem(p, "a table that is repeated must end with the value with which it begins");
    return;
  }
  const sph::TimeTable once = table;
  for (int k = 1; k < cycles; ++k) {
    for (std::size_t n = 1; n < once.time.size(); ++n) {
      table.time.push_back(k * once.time.back() + once.time[n]);
      table.value.push_back(once.value[n]);
    }
  }
}

void read_table(const InputReader& r, const Place& p, TimeCourse& c) {
  constexpr std::array<std::string_view, 3> keys = {"table", "smooth", "cycles"};
  r.known_keys(p, keys);
  c.form = Form::table;
  with(p, "table", [&](const Place& q) {
    if (!r.array(q, "rows [time, value]")) return;
    for (const JsonValue& row : q.value().items) read_row(r, Place(q, row), c.table);
  });
  if (c.table.time.size() < 2) {
    r.problem(p, "a table needs at least two rows [time, value]");
    c.table = sph::TimeTable::constant(0.0);
  }
  with(p, "smooth", [&](const Place& q) { c.table.smooth = boolean(r, q).value_or(false); });
  with(p, "cycles", [&](const Place& q) { repeat(r, q, r.integer(q, 1, most_cycles).value_or(1), c.table); });
}

/// The keys under which a component can be driven, and what their values are.
struct ActuationKey {
  std::string_view key;
  DriveKind kind;
  std::string_view value;  ///< the word for a value that is reached by a ramp
  bool begins_at_zero;     ///< a jump at the begin is a shock, or has no meaning
};
constexpr std::array<ActuationKey, 3> actuation_keys = {{{"velocity", DriveKind::velocity, "speed", false},
                                                         {"displacement", DriveKind::displacement, "value", true},
                                                         {"force", DriveKind::force, "value", true}}};

Servo read_servo(const InputReader& r, const Place& p, std::span<const std::string> gauges) {
  constexpr std::array<std::string_view, 6> keys = {"servo", "rate", "speed", "ramp", "fastest", "time_constant"};
  constexpr double fastest_times = 10.0;
  r.known_keys(p, keys);
  Servo s;
  with(p, "servo", [&](const Place& q) {
    const std::vector<std::string_view> names(gauges.begin(), gauges.end());
    s.gauge = std::string(word(r, q, names).value_or(""));
  });
  with_required(r, p, "rate", [&](const Place& q) { s.rate = r.positive(q).value_or(1.0); });
  with_required(r, p, "speed", [&](const Place& q) {
    s.speed = r.number(q).value_or(1.0);
    if (s.speed == 0.0) r.problem(q, "must be about as fast as the gauge asks for, and of the sign that lets it grow");
  });
  with(p, "ramp", [&](const Place& q) { s.ramp = not_negative(r, q).value_or(0.0); });
  s.fastest = fastest_times * std::abs(s.speed);
  with(p, "fastest", [&](const Place& q) { s.fastest = r.positive(q).value_or(s.fastest); });
  with(p, "time_constant", [&](const Place& q) { s.time_constant = r.positive(q).value_or(0.0); });
  return s;
}

Actuation read_actuation(const InputReader& r, const Place& p, const ActuationKey& key, const ActuationRules& rules) {
  if (key.kind == DriveKind::velocity && p.value().is(JsonValue::Kind::object) && p.value().find("servo") != nullptr) {
    Actuation a;
    a.kind = DriveKind::steered;
    a.servo = read_servo(r, p, rules.gauges);
    a.course.value = a.servo->speed, a.course.ramp = a.servo->ramp;  // about: what checks and estimates go by
    return a;
  }
  const CourseRules course{key.value, key.begins_at_zero, rules.first_stage, key.kind == DriveKind::displacement};
  return {key.kind, read_time_course(r, p, course), 0.0};
}

void read_machine(const InputReader& r, const Place& boundary, Actuations& drive) {
  with(boundary, "machine_stiffness", [&](const Place& p) {
    if (!r.object(p, "the stiffness (N/m) of the driven components, \"x\" or \"y\"")) return;
    r.known_keys(p, component_names);
    for (std::size_t c = 0; c < 2; ++c) {
      with(p, component_names[c], [&](const Place& q) {
        const double stiffness = r.positive(q).value_or(0.0);
        if (!drive[c] || drive[c]->kind == DriveKind::force) {
          r.problem(q, "this component has no velocity or displacement that a machine could pass on");
        } else {
          drive[c]->machine_stiffness = stiffness;
        }
      });
    }
  });
}

bool is_one_of(const JsonValue& v, std::span<const std::string_view> words) {
  return v.is(JsonValue::Kind::string) && std::find(words.begin(), words.end(), v.text) != words.end();
}

}  // namespace

TimeCourse read_time_course(const InputReader& r, const Place& p, const CourseRules& rules) {
  TimeCourse c;
  const std::string value = io::in_quotes(rules.value);
  if (p.value().is(JsonValue::Kind::number)) {
    c.value = r.number(p).value_or(0.0);
    if (rules.begins_at_zero && c.value != 0.0) {
      r.problem(p, "would act at once and shake the specimen: give it a ramp, {" + value + ": " +
                       io::shown(p.value().text) + ", \"ramp\": seconds}");
    }
    return c;
  }
  if (is_one_of(p.value(), rules.words)) {
    c.form = Form::hold;
    return c;
  }
  if (!p.value().is(JsonValue::Kind::object) || p.value().items.empty()) {
    r.problem(p, "expected a number, {" + value + ", \"ramp\"}, {\"table\": [[time, value], ...]} or \"hold\", found " +
                     p.value().description());
    return c;
  }
  if (p.value().find("table") == nullptr) {
    read_rise(r, p, rules.value, c);
    if (rules.begins_at_zero && c.value != 0.0 && c.ramp == 0.0) {
      r.problem(p, "needs a \"ramp\" (s) above 0: at once it would shake the specimen");
    }
    return c;
  }
  read_table(r, p, c);
  const bool first = rules.first_stage || rules.relative;
  if (rules.begins_at_zero && first && c.table.value.front() != 0.0) {
    r.problem(p, rules.relative ? "a displacement counts from where the boundary is when the stage begins: its table "
                                  "begins with [0, 0]"
                                : "the specimen is at rest at first: the table begins with [0, 0]");
  }
  return c;
}

bool read_actuations(const InputReader& r, const Place& boundary, const ActuationRules& rules, Actuations& drive,
                     std::array<bool, 2>* stated) {
  bool any = false;
  Actuations read;
  for (const ActuationKey& k : actuation_keys) {
    with(boundary, k.key, [&](const Place& p) {
      any = true;
      if (!r.object(p, "the driven components, \"x\" or \"y\" (the others are free)")) return;
      r.known_keys(p, component_names);
      for (std::size_t c = 0; c < 2; ++c) {
        with(p, component_names[c], [&](const Place& q) {
          if (read[c])
            r.problem(q, "this component is driven twice: by one of \"velocity\", \"displacement\" and \"force\"");
          read[c] = read_actuation(r, q, k, rules);
        });
      }
    });
  }
  for (std::size_t c = 0; c < 2; ++c) {
    if (!read[c]) continue;
    if (drive[c]) read[c]->machine_stiffness = drive[c]->machine_stiffness;
    drive[c] = read[c];
    if (stated != nullptr) (*stated)[c] = true;
  }
  read_machine(r, boundary, drive);
  return any;
}

}  // namespace fpz::specimen::detail
