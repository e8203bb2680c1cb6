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

constexpr Column all_columns[] = {
    {"stage", "-", "number of the stage, from 1; 0 in the initial state", [](const Row& r) { return double(r.stage); }},
    {"increment", "-", "number of the increment within the stage", [](const Row& r) { return double(r.increment); }},
    {"time", "-", "counts stages: 1.5 is half-way through stage 2", [](const Row& r) { return r.time; }},
    {"eps_xx", "-", "strain", strain<0>},
    {"eps_yy", "-", "strain", strain<1>},
    {"eps_zz", "-", "strain", strain<2>},
    {"eps_xy", "-", "strain, tensor component", strain<3>},
    {"eps_xz", "-", "strain, tensor component", strain<4>},
    {"eps_yz", "-", "strain, tensor component", strain<5>},
    {"sig_xx", "Pa", "stress, tension positive", stress<0>},
    {"sig_yy", "Pa", "stress", stress<1>},
    {"sig_zz", "Pa", "stress", stress<2>},
    {"sig_xy", "Pa", "stress", stress<3>},
    {"sig_xz", "Pa", "stress", stress<4>},
    {"sig_yz", "Pa", "stress", stress<5>},
    {"cracked", "-", "1 once the fracture exists; the columns from n_x to D are 0 before",
     [](const Row& r) { return r.cracked ? 1.0 : 0.0; }},
    {"n_x", "-", "normal of the crack plane", normal<0>},
    {"n_y", "-", "normal of the crack plane", normal<1>},
    {"n_z", "-", "normal of the crack plane", normal<2>},
    {"u_n", "m", "displacement jump since onset, normal, opening positive", jump<0>},
    {"u_s1", "m", "displacement jump, first shear direction", jump<1>},
    {"u_s2", "m", "displacement jump, second shear direction (0 in 2-D)", jump<2>},
    {"up_n", "m", "inelastic normal jump", [](const Row& r) { return r.plastic_normal; }},
    {"up_s", "m", "accumulated inelastic slip", [](const Row& r) { return r.plastic_slip; }},
    {"t_n", "Pa", "traction, normal", traction<0>},
    {"t_s1", "Pa", "traction, first shear direction", traction<1>},
    {"t_s2", "Pa", "traction, second shear direction (0 in 2-D)", traction<2>},
    {"D", "-", "damage", [](const Row& r) { return r.damage; }},
    {"energy_stored", "J/m^3", "elastic energy of bulk and crack", [](const Row& r) { return r.stored; }},
    {"energy_dissipated", "J/m^3", "dissipated energy", [](const Row& r) { return r.dissipated; }},
    {"iterations", "-", "integrator iterations that the increment needed",
     [](const Row& r) { return double(r.iterations); }},
    {"status", "-", "ok, or why the run stopped at this state", nullptr},
    {"energy_work", "J/m^3", "work of the stress, trapezoidal rule", [](const Row& r) { return r.work; }},
};

void append_number(std::string& text, double x) {
  char buffer[40];
  const int n = std::snprintf(buffer, sizeof buffer, "%.17g", x);
  text.append(buffer, static_cast<std::size_t>(n));
}

}  // namespace

std::span<const Column> columns() { return all_columns; }

const Column* find_column(std::string_view name) {
  const auto found =
      std::find_if(std::begin(all_columns), std::end(all_columns), [&](const Column& c) { return c.name == name; });
  return found == std::end(all_columns) ? nullptr : &*found;
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
