#include "fpz/driver/history.hpp"

#include <algorithm>
#include <cstdio>

#include "fpz/io/output.hpp"

namespace fpz::driver {
namespace {

template <int K>
double strain(const Row& r) {
  return r.strain[K];
}
template <int K>
double stress(const Row& r) {
  return r.stress[K];
}
template <int K>
double normal(const Row& r) {
  return r.normal[K];
}
template <int K>
double jump(const Row& r) {
  return r.jump[K];
}
template <int K>
double traction(const Row& r) {
  return r.traction[K];
}

using Q = Quantity;

// clang-format off
constexpr Column all_columns[] = {
    {"stage", "-", "number of the stage, from 1; 0 in the initial state", Q::count, [](const Row& r) { return double(r.stage); }},
    {"increment", "-", "number of the increment within the stage", Q::count, [](const Row& r) { return double(r.increment); }},
    {"time", "-", "counts stages: 1.5 is half-way through stage 2", Q::count, [](const Row& r) { return r.time; }, "T"},
    {"eps_xx", "-", "strain", Q::strain, strain<0>},
    {"eps_yy", "-", "strain", Q::strain, strain<1>},
    {"eps_zz", "-", "strain", Q::strain, strain<2>},
    {"eps_xy", "-", "strain, tensor component", Q::strain, strain<3>},
    {"eps_xz", "-", "strain, tensor component", Q::strain, strain<4>},
    {"eps_yz", "-", "strain, tensor component", Q::strain, strain<5>},
    {"sig_xx", "Pa", "stress, tension positive", Q::stress, stress<0>, "sxx"},
    {"sig_yy", "Pa", "stress", Q::stress, stress<1>, "syy"},
    {"sig_zz", "Pa", "stress", Q::stress, stress<2>, "szz"},
    {"sig_xy", "Pa", "stress", Q::stress, stress<3>, "sxy"},
    {"sig_xz", "Pa", "stress", Q::stress, stress<4>, "sxz"},
    {"sig_yz", "Pa", "stress", Q::stress, stress<5>, "syz"},
    {"cracked", "-", "1 once the fracture exists; the columns from n_x to D are 0 before", Q::fraction, [](const Row& r) { return r.cracked ? 1.0 : 0.0; }},
    {"n_x", "-", "normal of the crack plane", Q::fraction, normal<0>},
    {"n_y", "-", "normal of the crack plane", Q::fraction, normal<1>},
    {"n_z", "-", "normal of the crack plane", Q::fraction, normal<2>},
    {"u_n", "m", "displacement jump since onset, normal, opening positive", Q::jump, jump<0>, "un"},
    {"u_s1", "m", "displacement jump, first shear direction", Q::jump, jump<1>, "us1"},
    {"u_s2", "m", "displacement jump, second shear direction (0 in 2-D)", Q::jump, jump<2>, "us2"},
    {"up_n", "m", "inelastic normal jump", Q::jump, [](const Row& r) { return r.plastic_normal; }},
    {"up_s", "m", "accumulated inelastic slip", Q::jump, [](const Row& r) { return r.plastic_slip; }},
    {"t_n", "Pa", "traction, normal", Q::stress, traction<0>, "tn"},
    {"t_s1", "Pa", "traction, first shear direction", Q::stress, traction<1>, "ts1"},
    {"t_s2", "Pa", "traction, second shear direction (0 in 2-D)", Q::stress, traction<2>, "ts2"},
    {"D", "-", "damage", Q::fraction, [](const Row& r) { return r.damage; }},
    {"energy_stored", "J/m^3", "elastic energy of bulk and crack", Q::energy, [](const Row& r) { return r.stored; }},
    {"energy_dissipated", "J/m^3", "dissipated energy", Q::energy, [](const Row& r) { return r.dissipated; }},
    {"iterations", "-", "integrator iterations that the increment needed", Q::count, [](const Row& r) { return double(r.iterations); }},
    {"status", "-", "ok, or why the run stopped at this state", Q::count, nullptr},
    {"energy_work", "J/m^3", "work of the stress, trapezoidal rule", Q::energy, [](const Row& r) { return r.work; }},
};
// clang-format on

template <class F>
const Column* first_column(const F& is_it) {
  const auto* found = std::find_if(std::begin(all_columns), std::end(all_columns), is_it);
  return found == std::end(all_columns) ? nullptr : found;
}

void append_number(std::string& text, double x) {
  char buffer[40];
  const int n = std::snprintf(buffer, sizeof buffer, "%.17g", x);
  text.append(buffer, static_cast<std::size_t>(n));
}

}  // namespace

std::span<const Column> columns() { return all_columns; }

std::span<const std::string_view> numeric_column_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Column& c : all_columns) {
      if (c.get != nullptr) list.push_back(c.name);
    }
    return list;
  }();
  return names;
}

const Column* find_column(std::string_view name) {
  return first_column([name](const Column& c) { return c.name == name; });
}

const Column* find_column_or_alias(std::string_view name) {
  return first_column([name](const Column& c) { return c.name == name || (c.alias == name && !name.empty()); });
}

std::string to_csv(const History& history) {
  std::string text;
  text.reserve(history.size() * 500 + 500);
  for (const Column& c : all_columns) {
    if (!text.empty()) text += ',';
    text += c.name;
  }
  text += '\n';
  for (const Row& row : history) {
    bool first = true;
    for (const Column& c : all_columns) {
      if (!first) text += ',';
      first = false;
      if (c.get) {
        append_number(text, c.get(row));
      } else {
        text += row.status;
      }
    }
    text += '\n';
  }
  return text;
}

void write_history(const std::filesystem::path& file, const History& history, bool force) {
  io::write_text(file, to_csv(history), force);
}

}  // namespace fpz::driver
