// A polynomial through the runs of an expensive model around a point: what the fit sees in place of the model.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fpz/calibration/prediction.hpp"

namespace fpz::calibration {

/// How a fitted material parameter is scaled: y = ln x where it is positive, else y = x over half the range between its
/// bounds.
struct Coordinate {
  int place = 0;  ///< in parameter_info
  bool logarithmic = true;
  double scale = 1.0;

  [[nodiscard]] double of(double x) const;
  [[nodiscard]] double value(double y) const;
  [[nodiscard]] double slope(double x) const;  ///< dy/dx
};

/// Terms of the polynomial, each order with those before it.
enum class SurfaceOrder { constant, linear, squares, products };

/// How many coefficients a value has with this order in n parameters.
[[nodiscard]] Eigen::Index terms_of(SurfaceOrder order, Eigen::Index n);

/// One run: where, and what it gave.
struct SurfacePoint {
  Eigen::VectorXd y;       ///< coordinates
  Eigen::VectorXd values;  ///< SI
};

struct ResponseSurface {
  std::vector<Coordinate> coordinates;
  Eigen::VectorXd centre;  ///< y
  Eigen::VectorXd radius;  ///< of the runs around it; u = (y - centre)/radius
  SurfaceOrder order = SurfaceOrder::constant;
  Eigen::MatrixXd coefficients;  ///< row per value; terms 1, u_j, u_j^2, u_j u_k
};

/// How far from the centre, in radii, there is a prediction.
inline constexpr double surface_reach = 2.0;

/// The highest order for which `count` runs leave at least one degree of freedom (two for products).
[[nodiscard]] SurfaceOrder order_for(std::size_t count, Eigen::Index n);

/// Least squares through all points. Needs as many points as terms.
[[nodiscard]] ResponseSurface fit_surface(const std::vector<Coordinate>& coordinates, const Eigen::VectorXd& centre,
                                          const Eigen::VectorXd& radius, const std::vector<SurfacePoint>& points,
                                          SurfaceOrder order);

/// Values and exact derivatives of the polynomial. A failure beyond surface_reach: no runs are there.
[[nodiscard]] Prediction predict(const ResponseSurface& surface, const Parameters& parameters, bool derivatives);

}  // namespace fpz::calibration
