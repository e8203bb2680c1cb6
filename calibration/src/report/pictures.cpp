#include "pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "display.hpp"
#include "fpz/driver/run.hpp"
#include "fpz/io/gnuplot.hpp"

namespace fpz::calibration::detail {
namespace {

using io::gnuplot_number;
using io::gnuplot_quoted;
using io::Panel;
using io::PanelPlace;
using io::Picture;
using io::Series;
using Point = std::pair<double, double>;

// Colours that stay apart for colour-blind readers (Okabe and Ito) and in grey.
constexpr const char* data_colour = "#404040";
constexpr const char* fit_colour = "#0072B2";
constexpr const char* fit_band_colour = "#BBDDF2";
constexpr const char* predicted_colour = "#D55E00";
constexpr const char* predicted_band_colour = "#F7D4B8";
constexpr const char* limit_colour = "#009E73";
constexpr Eigen::Index most_error_bars = 80;

std::string pretty_symbol(const FitParameter& p) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> symbols = {{{"nu", "ν"},
                                                                                     {"sigma_t0", "σ_{t0}"},
                                                                                     {"c0", "c_0"},
                                                                                     {"phi", "φ"},
                                                                                     {"psi", "ψ"},
                                                                                     {"delta0", "δ_0"},
                                                                                     {"Kn", "K_n"},
                                                                                     {"Ks", "K_s"}}};
  for (const auto& [name, pretty] : symbols) {
    if (p.symbol == name) return std::string(pretty);
  }
  return io::gnuplot_plain(p.symbol);
}

std::string axis_label(const Axis& a) {
  return io::gnuplot_plain(a.label) + (a.unit.empty() ? "" : " (" + pretty_unit(a.unit) + ")");
}

std::string lines(const char* colour, double width, int dash = 1) {
  return "lines lw " + gnuplot_number(width) + " dt " + std::to_string(dash) + " lc rgb '" + colour + "'";
}

std::string points(const char* colour, int type, double size) {
  return "points pt " + std::to_string(type) + " ps " + gnuplot_number(size) + " lc rgb '" + colour + "'";
}

std::vector<Point> curve(const Eigen::VectorXd& x, double x_factor, const Eigen::VectorXd& y, double y_factor) {
  std::vector<Point> list;
  for (Eigen::Index k = 0; k < x.size(); ++k) list.emplace_back(x[k] / x_factor, y[k] / y_factor);
  return list;
}

/// What the model predicts, with points of its own between the measured ones where it has them.
std::vector<Point> predicted_curve(const DataSet& set, const Comparison& c) {
  const Eigen::VectorXd& x = c.smooth ? c.smooth->abscissa : set.abscissa;
  const Eigen::VectorXd& y = c.smooth ? c.smooth->predicted : c.predicted;
  return curve(x, set.abscissa_axis.factor, y, set.value_axis.factor);
}

/// The outline of the band: there on its upper side, back on the lower one.
std::vector<Point> outline(const std::vector<Point>& middle, const Eigen::VectorXd& half_width, double factor) {
  std::vector<Point> list;
  for (std::size_t k = 0; k < middle.size(); ++k) {
    list.emplace_back(middle[k].first, middle[k].second + half_width[static_cast<Eigen::Index>(k)] / factor);
  }
  for (std::size_t k = middle.size(); k-- > 0;) {
    list.emplace_back(middle[k].first, middle[k].second - half_width[static_cast<Eigen::Index>(k)] / factor);
  }
  return list;
}

/// Segments between pairs of points, apart from each other.
std::vector<Point> segments(const std::vector<std::pair<Point, Point>>& pairs) {
  std::vector<Point> list;
  for (const auto& [a, b] : pairs) {
    list.push_back(a);
    list.push_back(b);
    list.emplace_back(NAN, NAN);
  }
  return list;
}

/// A range with some room around all points.
Point padded(const std::vector<Series>& series, bool vertical) {
  double low = INFINITY, high = -INFINITY;
  for (const Series& s : series) {
    for (const Point& p : s.points) {
      const double v = vertical ? p.second : p.first;
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(low < high)) return {low - 1.0, low + 1.0};
  const double room = 0.04 * (high - low);
  return {low == 0.0 ? 0.0 : low - room, high + room};
}

Picture curve_picture(const Calibration& all, const Comparison& c) {
  const DataSet& set = all.specification.data[c.data_set];
  const bool fitted = set.role == Role::fit;
  const char* colour = fitted ? fit_colour : predicted_colour;
  const double fx = set.abscissa_axis.factor;
  const double fy = set.value_axis.factor;
  const std::string level = digits(100.0 * all.specification.options.confidence) + " %";
  std::vector<Series> series;
  if (c.ok()) {
    const std::vector<Point> middle = predicted_curve(set, c);
    const Eigen::VectorXd& band = c.smooth ? c.smooth->band : c.band;
    const std::string fill = std::string("filledcurves closed fs solid noborder fc rgb '") +
                             (fitted ? fit_band_colour : predicted_band_colour) + "'";
    if (band.maxCoeff() > 0.0) series.push_back({level + " band", fill, outline(middle, band, fy)});
  }
  const Eigen::VectorXd& deviation = c.ok() ? c.deviation : set.deviation;
  const bool scatter = set.measured.size() <= most_error_bars && (set.deviation_known || (fitted && c.ok()));
  if (scatter) {
    std::vector<std::pair<Point, Point>> bars;
    for (Eigen::Index k = 0; k < set.measured.size(); ++k) {
      const double x = set.abscissa[k] / fx;
      bars.push_back({{x, (set.measured[k] - deviation[k]) / fy}, {x, (set.measured[k] + deviation[k]) / fy}});
    }
    series.push_back({"", lines("#9A9A9A", 1.0), segments(bars)});
  }
  series.push_back({scatter ? "measured ± 1 s.d." : "measured", points(data_colour, 7, 0.45),
                    curve(set.abscissa, fx, set.measured, fy)});
  if (c.ok()) {
    series.push_back({fitted ? "fit" : "prediction", lines(colour, 2.4), predicted_curve(set, c)});
  }
  Picture picture(data_picture_name(set), 860, 580);
  Panel panel;
  panel.title = io::gnuplot_plain(set.name) + (fitted ? "" : ": not fitted, predicted");
  panel.x_label = axis_label(set.abscissa_axis);
  panel.y_label = axis_label(set.value_axis);
  panel.before = "set ylabel offset -0.4,0";
  panel.series = series;
  panel.x = padded(series, false);
  panel.y = padded(series, true);
  picture.panel(panel, {0.12, 0.975, 0.19, 0.92});
  picture.legend(series, {0.1, 0.97, 0.01, 0.07}, 3);
  return picture;
}

/// Predicted over measured, one row per value, so that kN and MPa can stand together.
Picture values_picture(const Calibration& all, const Comparison& c) {
  const DataSet& set = all.specification.data[c.data_set];
  const char* colour = set.role == Role::fit ? fit_colour : predicted_colour;
  const Eigen::Index n = set.measured.size();
  std::vector<std::pair<Point, Point>> bars, bands;
  std::vector<Point> measured, predicted;
  std::string names;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto y = static_cast<double>(n - k);
    const double scale = 100.0 / set.measured[k];
    const double d = scale * (c.ok() ? c.deviation[k] : set.deviation[k]);
    bars.push_back({{100.0 - d, y + 0.1}, {100.0 + d, y + 0.1}});
    measured.emplace_back(100.0, y + 0.1);
    names += (k > 0 ? ", " : "") + gnuplot_quoted(io::gnuplot_plain(set.labels[static_cast<std::size_t>(k)])) + ' ' +
             gnuplot_number(y);
    if (!c.ok()) continue;
    predicted.emplace_back(scale * c.predicted[k], y - 0.1);
    bands.push_back({{scale * (c.predicted[k] - c.band[k]), y - 0.1}, {scale * (c.predicted[k] + c.band[k]), y - 0.1}});
  }
  const std::string level = digits(100.0 * all.specification.options.confidence) + " %";
  std::vector<Series> series = {{"", lines("#9A9A9A", 2.0), segments(bars)},
                                {"measured ± 1 s.d.", points(data_colour, 7, 0.9), measured},
                                {"", lines(colour, 2.0), segments(bands)},
                                {std::string(set.role == Role::fit ? "fit" : "prediction") + ", " + level + " interval",
                                 points(colour, 5, 0.9), predicted}};
  const int height = 230 + 40 * static_cast<int>(std::min<Eigen::Index>(n, 40));
  Picture picture(data_picture_name(set), 860, height);
  Panel panel;
  panel.title = io::gnuplot_plain(set.name);
  panel.x_label = "Value over the measured one (%)";
  panel.before = "set ytics (" + names + ")";
  panel.series = series;
  panel.x = padded(series, false);
  panel.y = {0.4, static_cast<double>(n) + 0.6};
  const double bottom = 140.0 / height;
  picture.panel(panel, {0.3, 0.965, bottom, 1.0 - 45.0 / height});
  picture.legend(series, {0.1, 0.97, 8.0 / height, 58.0 / height}, 2);
  return picture;
}

/// 1, 2, 3, 5 and 7 times the powers of ten in a range, as gnuplot lists tics.
std::string decade_tics(const Point& range) {
  std::string list;
  for (double power = std::pow(10.0, std::floor(std::log10(range.first))); power < range.second; power *= 10.0) {
    for (const double digit : {1.0, 2.0, 3.0, 5.0, 7.0}) {
      const double tic = digit * power;
      if (tic < range.first || tic > range.second) continue;
      list += (list.empty() ? "" : ", ") + gnuplot_quoted(digits(tic)) + ' ' + gnuplot_number(tic);
    }
  }
  return list;
}

/// Nominal stress over size on logarithmic axes. Specimens of several shapes are brought together by g and g' (Bazant
/// and Kazemi): P sqrt(g')/(thickness D) over D g/g'.
Picture draw_size_effect(const DataSet& set, const SizeEffect& e) {
  std::vector<Point> measured, model, law, model_curve;
  const auto shown = [&](const GeometryFunction& f, double size, double stress) {
    const double g = f.g(), s = f.g_slope();
    return e.similar ? Point{1e3 * size, 1e-6 * stress} : Point{1e3 * size * g / s, 1e-6 * stress * std::sqrt(s)};
  };
  const GeometryFunction& shape = e.points.front().geometry;
  double low = INFINITY, high = 0.0;
  for (const SizeEffectPoint& p : e.points) {
    measured.push_back(shown(p.geometry, p.size, p.stress));
    model.push_back(shown(p.geometry, p.size, p.model_stress));
    low = std::min(low, p.size * p.geometry.g() / p.geometry.g_slope());
    high = std::max(high, p.size * p.geometry.g() / p.geometry.g_slope());
  }
  for (int k = 0; k <= 40; ++k) {
    const double brittleness = 0.5 * low * std::pow(4.0 * high / low, k / 40.0);
    const double stress = std::sqrt(e.plane_modulus * e.law.energy / (shape.g_slope() * (e.law.length + brittleness)));
    law.push_back(shown(shape, brittleness * shape.g_slope() / shape.g(), stress));
  }
  for (std::size_t k = 0; k < e.curve.size.size(); ++k) {
    model_curve.push_back(shown(shape, e.curve.size[k], e.curve.model_stress[k]));
  }
  std::vector<Series> series = {{"size-effect law", lines(predicted_colour, 2.2, 2), law}};
  if (model_curve.empty()) {
    series.push_back({"cohesive model", points(fit_colour, 6, 1.3), model});
  } else {
    series.push_back({"cohesive model", lines(fit_colour, 2.2), model_curve});
  }
  series.push_back({"measured", points(data_colour, 7, 0.8), measured});
  Picture picture(size_effect_picture_name(set), 760, 560);
  Panel panel;
  panel.title = "Size effect: " + io::gnuplot_plain(set.name);
  panel.x_label = e.similar ? "Size D (mm)" : "Brittle size D g/g' (mm)";
  panel.y_label = e.similar ? "Nominal stress P/(t D) (MPa)" : "P (g')^{1/2}/(t D) (MPa)";
  panel.series = series;
  panel.log_x = panel.log_y = true;
  const auto range = [&](double Point::*which) {
    double least = INFINITY, most = 0.0;
    for (const Series& s : series) {
      for (const Point& p : s.points) {
        least = std::min(least, p.*which);
        most = std::max(most, p.*which);
      }
    }
    return Point{0.92 * least, 1.08 * most};
  };
  panel.x = range(&Point::first);
  panel.y = range(&Point::second);
  panel.before = "set format '%g'\nset xtics (" + decade_tics(panel.x) + ")\nset ytics (" + decade_tics(panel.y) + ")";
  picture.panel(panel, {0.125, 0.97, 0.2, 0.92});
  picture.legend(series, {0.1, 0.97, 0.01, 0.07}, 3);
  return picture;
}

Picture draw_residuals(const Calibration& all) {
  struct One {
    const DataSet* set;
    const DataSetResult* result;
  };
  std::vector<One> sets;
  std::size_t next = 0;
  for (const DataSet& set : all.specification.data) {
    if (set.role != Role::fit || next >= all.result.data.size()) continue;
    const DataSetResult& result = all.result.data[next++];
    if (result.standardised.size() == set.measured.size()) sets.push_back({&set, &result});
  }
  const int rows = static_cast<int>(std::max<std::size_t>(sets.size(), 1));
  const int height = 60 + 240 * rows;
  Picture picture(residuals_picture, 860, height);
  const auto places = io::grid(rows, 1, {0.105, 0.975, 70.0 / height, 1.0 - 40.0 / height}, 0.0, 95.0 / height);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const DataSet& set = *sets[k].set;
    const Eigen::VectorXd& z = sets[k].result->standardised;
    const std::vector<Point> values = curve(set.abscissa, set.is_curve() ? set.abscissa_axis.factor : 1.0, z, 1.0);
    Panel panel;
    panel.title = io::gnuplot_plain(set.name);
    panel.x_label = set.is_curve() ? axis_label(set.abscissa_axis) : "Number of the value";
    panel.y_label = "(fit - data)/s.d.";
    Series marks{"", points(fit_colour, 7, z.size() > 40 ? 0.5 : 0.8), values};
    panel.x = padded({marks}, false);
    if (!set.is_curve()) panel.x = {0.5, static_cast<double>(z.size()) + 0.5};
    const double top = 1.1 * std::max(3.0, z.cwiseAbs().maxCoeff());
    panel.y = {-top, top};
    const auto level = [&](double y, const std::string& style) {
      panel.series.push_back({"", style, {{panel.x.first, y}, {panel.x.second, y}}});
    };
    level(0.0, lines("#606060", 1.2));
    level(2.0, lines(limit_colour, 1.4, 2));
    level(-2.0, lines(limit_colour, 1.4, 2));
    panel.series.push_back(marks);
    picture.panel(panel, places[k]);
  }
  return picture;
}

Picture draw_profile(const Calibration& all, const Profile& p) {
  const FitParameter& q = all.problem.parameters[static_cast<std::size_t>(p.parameter)];
  const double best = all.result.values[p.parameter];
  const Display unit = display(q.unit, best);
  std::vector<Point> line;
  double high = 2.5 * p.threshold;
  for (Eigen::Index k = 0; k < p.values.size(); ++k) {
    if (std::isfinite(p.excess[k])) line.emplace_back(p.values[k] / unit.factor, p.excess[k]);
  }
  std::sort(line.begin(), line.end());
  Panel panel;
  panel.x = padded({{"", "", line}}, false);
  const double level = 100.0 * all.specification.options.confidence;
  const auto vertical = [&](double x) { return std::vector<Point>{{x / unit.factor, 0.0}, {x / unit.factor, high}}; };
  std::vector<Series> series;
  if (p.lower && p.upper) {
    const double a = *p.lower / unit.factor, b = *p.upper / unit.factor;
    series.push_back({digits(level) + " % interval",
                      "filledcurves closed fs solid noborder fc rgb '#D5EFE6'",
                      {{a, 0.0}, {b, 0.0}, {b, high}, {a, high}}});
  } else {
    for (const auto& end : {p.lower, p.upper}) {
      if (end) series.push_back({"end of the interval", lines(limit_colour, 1.6, 2), vertical(*end)});
    }
  }
  series.push_back({digits(level) + " % threshold",
                    lines(predicted_colour, 1.8, 2),
                    {{panel.x.first, p.threshold}, {panel.x.second, p.threshold}}});
  series.push_back({"best value", lines("#606060", 1.6, 3), vertical(best)});
  series.push_back({"profile", "linespoints pt 7 ps 0.5 lw 2.2 lc rgb '" + std::string(fit_colour) + "'", line});
  panel.title = "Profile likelihood";
  panel.x_label = pretty_symbol(q) + (unit.unit.empty() ? "" : " (" + pretty_unit(unit.unit) + ")");
  panel.y_label = "Excess of the cost, 2 (C - C_{min})/s^2";
  panel.y = {0.0, high};
  panel.series = series;
  Picture picture(profile_picture_name(q.name), 760, 540);
  picture.panel(panel, {0.115, 0.97, 0.215, 0.92});
  picture.legend(series, {0.1, 0.97, 0.01, 0.08}, 4);
  return picture;
}

/// Blue for positive, orange for negative, white for none.
std::string correlation_colour(double c) {
  const std::array<double, 3> full =
      c >= 0.0 ? std::array<double, 3>{0.0, 114.0, 178.0} : std::array<double, 3>{213.0, 94.0, 0.0};
  const double s = std::min(1.0, std::abs(c)) * 0.85;
  std::array<char, 8> text{};
  const auto mix = [&](std::size_t k) { return static_cast<int>(std::lround(255.0 + s * (full[k] - 255.0))); };
  std::snprintf(text.data(), text.size(), "#%02X%02X%02X", mix(0), mix(1), mix(2));
  return text.data();
}

Picture draw_correlation(const Calibration& all) {
  const Eigen::MatrixXd& c = all.result.correlation;
  const Eigen::Index n = c.rows();
  const int size = 190 + 78 * static_cast<int>(n);
  Picture picture(correlation_picture, size, size);
  Panel panel;
  panel.title = "Correlation";
  panel.x = {0.5, static_cast<double>(n) + 0.5};
  panel.y = {0.5, static_cast<double>(n) + 0.5};
  std::string x_names, y_names;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::string name = gnuplot_quoted(pretty_symbol(all.problem.parameters[static_cast<std::size_t>(k)]));
    x_names += (k > 0 ? ", " : "") + name + ' ' + std::to_string(k + 1);
    y_names += (k > 0 ? ", " : "") + name + ' ' + std::to_string(n - k);
  }
  panel.before = "unset grid\nset tics scale 0\nset xtics (" + x_names + ")\nset ytics (" + y_names + ")\n";
  int object = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const double x = static_cast<double>(k + 1), y = static_cast<double>(n - i);
      const double value = std::isfinite(c(i, k)) ? c(i, k) : 0.0;
      panel.before += "set object " + std::to_string(object) + " rectangle from " + gnuplot_number(x - 0.5) + ',' +
                      gnuplot_number(y - 0.5) + " to " + gnuplot_number(x + 0.5) + ',' + gnuplot_number(y + 0.5) +
                      " behind fillcolor rgb '" + correlation_colour(value) + "' fillstyle solid border rgb 'white'\n";
      std::array<char, 16> text{};
      std::snprintf(text.data(), text.size(), "%.2f", c(i, k));
      panel.before += "set label " + std::to_string(object++) + " '" + text.data() + "' at " + gnuplot_number(x) + ',' +
                      gnuplot_number(y) + " center textcolor rgb '" + (std::abs(value) > 0.65 ? "white" : "#202020") +
                      "'\n";
    }
  }
  panel.series = {{"", "points pt 7 ps 0 lc rgb 'white'", {{1.0, 1.0}}}};
  picture.panel(panel, {120.0 / size, 0.97, 80.0 / size, 1.0 - 50.0 / size});
  return picture;
}

}  // namespace

std::string data_picture_name(const DataSet& set) { return "data_" + driver::folder_name(set.name); }

std::string size_effect_picture_name(const DataSet& set) { return "size_effect_" + driver::folder_name(set.name); }

std::string profile_picture_name(const std::string& parameter) { return "profile_" + driver::folder_name(parameter); }

std::vector<std::string> picture_names(const Specification& spec) {
  std::vector<std::string> names;
  for (const DataSet& set : spec.data) names.push_back(data_picture_name(set));
  for (const DataSet& set : spec.data) {
    if (std::holds_alternative<PeakLoadTest>(set.test)) names.push_back(size_effect_picture_name(set));
  }
  for (const std::string& p : spec.profiles) names.push_back(profile_picture_name(p));
  names.emplace_back(residuals_picture);
  names.emplace_back(correlation_picture);
  return names;
}

std::vector<Picture> draw_pictures(const Calibration& all) {
  std::vector<Picture> list;
  bool any_residuals = false;
  for (const Comparison& c : all.comparisons) {
    const DataSet& set = all.specification.data[c.data_set];
    list.push_back(set.is_curve() ? curve_picture(all, c) : values_picture(all, c));
    if (c.size_effect && c.size_effect->law.ok()) list.push_back(draw_size_effect(set, *c.size_effect));
    any_residuals = any_residuals || (set.role == Role::fit && c.ok());
  }
  if (any_residuals) list.push_back(draw_residuals(all));
  for (const Profile& p : all.result.profiles) list.push_back(draw_profile(all, p));
  if (all.result.correlation.rows() > 1) list.push_back(draw_correlation(all));
  return list;
}

}  // namespace fpz::calibration::detail
