// Curves taken out of a history for drawing: selected, scaled, cut into stages and thinned.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fpz/io/csv.hpp"

namespace fpz::driver {

struct XY {
  double x = 0.0;
  double y = 0.0;
  double c = 0.0;  ///< third value, for colour
};
using Points = std::vector<XY>;

struct Curve {
  Points points;
  std::string style;  ///< gnuplot's, after "with"
  std::string title;  ///< empty: not in the legend
};

struct Range {
  double lo = 0.0;
  double hi = 0.0;
  bool empty = true;
  void add(double v);
  /// Widened by a margin on both sides; never of zero width.
  [[nodiscard]] Range padded(double margin) const;
};

/// One set of axes.
struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  std::string key = "below horizontal";  ///< placement; under the axes nothing is covered
  bool legend = true;
};

/// Removes points that lie on the line between their neighbours to within `tolerance` of the picture's size
/// (Douglas-Peucker).
[[nodiscard]] Points thin(const Points& points, double tolerance = 2e-4);

/// Colour of stage number k (from 0) of `count`: distinct colours for a few stages, a ramp for many.
[[nodiscard]] std::string stage_colour(int k, int count);

/// What the pictures show of a history, in MPa, micrometres and thousandths.
class HistoryCurves {
 public:
  explicit HistoryCurves(const io::Table& table);

  [[nodiscard]] int stages() const { return stages_; }
  [[nodiscard]] Panel stress_strain(const std::string& component) const;
  /// Are stress and strain of the component anything but zero?
  [[nodiscard]] bool is_active(const std::string& component) const;
  [[nodiscard]] Panel normal_traction() const;
  [[nodiscard]] Panel shear_traction() const;
  [[nodiscard]] Panel loading_path() const;
  [[nodiscard]] Panel damage() const;
  [[nodiscard]] Panel energies() const;
  /// Traction path (t_n, t_s, D).
  [[nodiscard]] Points traction_path() const;
  [[nodiscard]] bool shear_is_magnitude() const { return magnitude_; }

 private:
  using Pick = std::function<double(std::size_t)>;
  [[nodiscard]] std::vector<Curve> by_stage(const Pick& x, const Pick& y,
                                            const std::function<bool(std::size_t)>& use) const;
  [[nodiscard]] Points over_time(const Pick& y) const;
  [[nodiscard]] bool elastic_cracked(int stage) const;
  void find_local();

  const io::Table& table_;
  int stages_ = 0;
  bool magnitude_ = false;               ///< 3-D: the shear is drawn as a magnitude
  std::vector<double> u_s_, t_n_, t_s_;  ///< local quantities; in 2-D the tractions before onset, too
  std::vector<char> has_local_;
};

/// The yield surface (eq 48 of the paper) at damage D: t_s over t_n, both halves, MPa, down to t_n = `lowest`.
[[nodiscard]] Points yield_curve(double tensile_strength, double cohesion, double friction_angle_deg, double damage,
                                 double lowest);

}  // namespace fpz::driver
