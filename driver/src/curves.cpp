#include "curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

constexpr double mega = 1e-6;  // Pa -> MPa
constexpr double micro = 1e6;  // m -> um
constexpr double milli = 1e3;  // 1 -> 1e-3
constexpr int most_distinct = 8;

std::string line(const std::string& colour, const char* width = "2.5") {
  return std::string("lines lw ").append(width).append(" lc rgb '").append(colour).append("'");
}

std::string subscript(const std::string& component) { return std::string("_{").append(component).append("}"); }

double distance_from_chord(const XY& p, const XY& a, const XY& b, double sx, double sy) {
  const double dx = (b.x - a.x) * sx;
  const double dy = (b.y - a.y) * sy;
  const double px = (p.x - a.x) * sx;
  const double py = (p.y - a.y) * sy;
  const double length = std::hypot(dx, dy);
  if (length == 0.0) return std::hypot(px, py);
  const double along = std::clamp((px * dx + py * dy) / (length * length), 0.0, 1.0);
  return std::hypot(px - along * dx, py - along * dy);
}

}  // namespace

void Range::add(double v) {
  if (!std::isfinite(v)) return;
  lo = empty ? v : std::min(lo, v);
  hi = empty ? v : std::max(hi, v);
  empty = false;
}

Range Range::padded(double margin) const {
  Range r = *this;
  if (r.empty) r.hi = 1.0;
  r.empty = false;
  const double width = r.hi - r.lo;
  const double pad = width > 0.0 ? margin * width : std::max(1.0, std::abs(r.lo));
  r.lo -= pad;
  r.hi += pad;
  return r;
}

Points thin(const Points& points, double tolerance) {
  if (points.size() < 3) return points;
  Range x, y, c;
  for (const XY& p : points) {
    x.add(p.x);
    y.add(p.y);
    c.add(p.c);
  }
  const auto inverse = [](const Range& r) { return r.hi > r.lo ? 1.0 / (r.hi - r.lo) : 0.0; };
  std::vector<char> keep(points.size(), 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double most = tolerance;
    std::size_t far = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double d = distance_from_chord(points[i], points[a], points[b], inverse(x), inverse(y));
      if (d > most) {
        most = d;
        far = i;
      }
    }
    // The colour has to change smoothly even along a straight line.
    if (far == a && b > a + 1 && std::abs(points[b].c - points[a].c) * inverse(c) > 0.02) far = (a + b) / 2;
    if (far == a) continue;
    keep[far] = 1;
    open.emplace_back(a, far);
    open.emplace_back(far, b);
  }
  Points out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) out.push_back(points[i]);
  }
  return out;
}

std::string stage_colour(int k, int count) {
  // Okabe & Ito's colours, told apart by colour-blind readers, too.
  static constexpr std::array<const char*, most_distinct> distinct = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                                      "#E69F00", "#56B4E9", "#5D3A9B", "#000000"};
  if (count <= most_distinct) return distinct[static_cast<std::size_t>(k)];
  const double x = 2.0 * k / (count - 1);  // blue, purple, orange
  const auto mix = [x](double a, double b, double c) {
    return static_cast<unsigned>(std::lround(x < 1.0 ? a + x * (b - a) : b + (x - 1.0) * (c - b))) & 0xFFu;
  };
  char text[16];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", mix(0, 163, 240), mix(64, 30, 135), mix(150, 140, 20));
  return text;
}

HistoryCurves::HistoryCurves(const io::Table& table) : table_(table) {
  for (const double s : table.at("stage")) {
    if (std::isfinite(s)) stages_ = std::max(stages_, static_cast<int>(s));
  }
  find_local();
}

/// Local shear and tractions. The history has none before onset; in 2-D they follow from the stress and the plane that
/// cracks later, and the curves begin at the origin as in figure 5 of the paper.
void HistoryCurves::find_local() {
  const auto& cracked = table_.at("cracked");
  const auto& ts2 = table_.at("t_s2");
  const auto& us2 = table_.at("u_s2");
  const auto& ts1 = table_.at("t_s1");
  const auto& us1 = table_.at("u_s1");
  const std::size_t n = table_.rows();
  const auto zero = [](double v) { return v == 0.0; };
  magnitude_ = !std::all_of(ts2.begin(), ts2.end(), zero) || !std::all_of(us2.begin(), us2.end(), zero);
  u_s_.assign(n, 0.0);
  t_n_ = table_.at("t_n");
  t_s_.assign(n, 0.0);
  has_local_.assign(n, 0);
  const auto first = static_cast<std::size_t>(std::find(cracked.begin(), cracked.end(), 1.0) - cracked.begin());
  for (std::size_t i = first; i < n; ++i) {
    has_local_[i] = cracked[i] == 1.0;
    u_s_[i] = magnitude_ ? std::hypot(us1[i], us2[i]) : us1[i];
    t_s_[i] = magnitude_ ? std::hypot(ts1[i], ts2[i]) : ts1[i];
  }
  if (first == n || magnitude_ || table_.at("n_z")[first] != 0.0) return;
  const double nx = table_.at("n_x")[first];
  const double ny = table_.at("n_y")[first];
  const auto& xx = table_.at("sig_xx");
  const auto& yy = table_.at("sig_yy");
  const auto& xy = table_.at("sig_xy");
  for (std::size_t i = 0; i < first; ++i) {
    has_local_[i] = 1;
    t_n_[i] = nx * nx * xx[i] + ny * ny * yy[i] + 2.0 * nx * ny * xy[i];
    t_s_[i] = nx * ny * (yy[i] - xx[i]) + (nx * nx - ny * ny) * xy[i];
  }
}

/// Does the damage of the fracture stay as it is during the stage?
bool HistoryCurves::elastic_cracked(int number) const {
  const auto& stage = table_.at("stage");
  const auto& d = table_.at("D");
  double first = 0.0;
  double last = 0.0;
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    if (stage[i] < number) first = d[i];
    if (stage[i] <= number) last = d[i];
  }
  return first > 0.0 && first == last;
}

std::vector<Curve> HistoryCurves::by_stage(const Pick& x, const Pick& y,
                                           const std::function<bool(std::size_t)>& use) const {
  const auto& stage = table_.at("stage");
  std::vector<Curve> curves;
  const int every = stages_ <= most_distinct ? 1 : (stages_ + most_distinct - 1) / most_distinct;
  for (int k = 1; k <= stages_; ++k) {
    Curve curve;
    // An elastic stage is usually retraced by the next one, which would hide it.
    curve.style = line(stage_colour(k - 1, stages_), stages_ <= most_distinct && elastic_cracked(k) ? "6" : "2.5");
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      const bool here = stage[i] == k;
      const bool just_before = i + 1 < table_.rows() && stage[i + 1] == k && stage[i] < k;  // stages join
      if ((here || just_before) && use(i) && std::isfinite(x(i)) && std::isfinite(y(i)))
        curve.points.push_back({x(i), y(i), 0.0});
    }
    if (curve.points.size() < 2) continue;
    curve.points = thin(curve.points);
    if ((k - 1) % every == 0 || k == stages_) curve.title = "Stage " + std::to_string(k);
    curves.push_back(std::move(curve));
  }
  return curves;
}

Points HistoryCurves::over_time(const Pick& y) const {
  const auto& time = table_.at("time");
  Points points;
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    if (std::isfinite(y(i))) points.push_back({time[i], y(i), 0.0});
  }
  return thin(points);
}

Panel HistoryCurves::stress_strain(const std::string& component) const {
  const auto& strain = table_.at("eps_" + component);
  const auto& stress = table_.at("sig_" + component);
  Panel p;
  p.x_label = "Strain ε" + subscript(component) + " (10^{-3})";
  p.y_label = "Stress σ" + subscript(component) + " (MPa)";
  p.curves = by_stage([&](std::size_t i) { return milli * strain[i]; }, [&](std::size_t i) { return mega * stress[i]; },
                      [](std::size_t) { return true; });
  return p;
}

bool HistoryCurves::is_active(const std::string& component) const {
  const auto any = [](const std::vector<double>& v) {
    return std::any_of(v.begin(), v.end(), [](double x) { return x != 0.0; });
  };
  return any(table_.at("eps_" + component)) && any(table_.at("sig_" + component));
}

Panel HistoryCurves::normal_traction() const {
  const auto& jump = table_.at("u_n");
  Panel p;
  p.x_label = "Normal jump u_n (µm)";
  p.y_label = "Normal traction t_n (MPa)";
  p.curves = by_stage([&](std::size_t i) { return micro * jump[i]; }, [&](std::size_t i) { return mega * t_n_[i]; },
                      [&](std::size_t i) { return has_local_[i] != 0; });
  return p;
}

Panel HistoryCurves::shear_traction() const {
  Panel p;
  p.x_label = magnitude_ ? "Shear jump |u_s| (µm)" : "Shear jump u_s (µm)";
  p.y_label = magnitude_ ? "Shear traction |t_s| (MPa)" : "Shear traction t_s (MPa)";
  p.curves = by_stage([&](std::size_t i) { return micro * u_s_[i]; }, [&](std::size_t i) { return mega * t_s_[i]; },
                      [&](std::size_t i) { return has_local_[i] != 0; });
  return p;
}

Panel HistoryCurves::loading_path() const {
  Panel p;
  p.x_label = "Time (stages)";
  p.y_label = "Strain (10^{-3})";
  int colour = 0;
  for (const std::string_view name : component_names) {
    const std::string component(name);
    const auto& strain = table_.at("eps_" + component);
    const bool moves = std::any_of(strain.begin(), strain.end(), [](double v) { return v != 0.0; });
    if (!moves) continue;
    p.curves.push_back({over_time([&](std::size_t i) { return milli * strain[i]; }),
                        line(stage_colour(colour, most_distinct)), "ε" + subscript(component)});
    ++colour;
  }
  return p;
}

Panel HistoryCurves::damage() const {
  const auto& d = table_.at("D");
  Panel p;
  p.x_label = "Time (stages)";
  p.y_label = "Damage D";
  p.legend = false;
  p.curves.push_back({over_time([&](std::size_t i) { return d[i]; }), line("#000000"), ""});
  return p;
}

Panel HistoryCurves::energies() const {
  Panel p;
  p.x_label = "Time (stages)";
  p.y_label = "Energy (J/m^3)";
  p.key = "at graph 0.5,-0.255 center top horizontal maxrows 1";
  const auto add = [&](const char* column, const char* title, const std::string& style) {
    const auto* energy = table_.find(column);
    if (energy) p.curves.push_back({over_time([&](std::size_t i) { return (*energy)[i]; }), style, title});
  };
  add("energy_work", "work", "lines lw 5 lc rgb '#BBBBBB'");
  add("energy_dissipated", "dissipated", line("#D55E00"));
  add("energy_stored", "stored", line("#0072B2"));
  return p;
}

Points HistoryCurves::traction_path() const {
  const auto& d = table_.at("D");
  Points points;
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    if (has_local_[i] && std::isfinite(t_n_[i]) && std::isfinite(t_s_[i]))
      points.push_back({mega * t_n_[i], mega * t_s_[i], d[i]});
  }
  return thin(points);
}

Points yield_curve(double tensile_strength, double cohesion, double friction_angle_deg, double damage, double lowest) {
  const double w = 1.0 - damage;
  const double tan_phi = std::tan(friction_angle_deg * std::numbers::pi / 180.0);
  const double vertex = w * tensile_strength * mega;
  const double apex = w * (cohesion - tensile_strength * tan_phi) * mega;
  constexpr int half = 100;
  Points points;
  for (int i = -half; i <= half; ++i) {
    const double q = static_cast<double>(i) / half;
    const double tn = vertex - (vertex - lowest) * q * q;  // dense at the vertex, where the curve turns
    const double reach = w * cohesion * mega - tn * tan_phi;
    const double ts = std::sqrt(std::max(0.0, reach * reach - apex * apex));
    points.push_back({tn, q < 0.0 ? ts : -ts, damage});
  }
  return points;
}

}  // namespace fpz::driver
