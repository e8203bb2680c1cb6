#include "fpz/calibration/response_surface.hpp"

#include <Eigen/QR>
#include <cmath>

#include "words.hpp"

namespace fpz::calibration {
namespace {

struct Terms {
  Eigen::RowVectorXd values;
  Eigen::MatrixXd slopes;  ///< row per parameter: d term / d u_j
};

Terms terms_at(const Eigen::VectorXd& u, SurfaceOrder order) {
  const Eigen::Index n = u.size();
  Terms t{Eigen::RowVectorXd::Zero(terms_of(order, n)), Eigen::MatrixXd::Zero(n, terms_of(order, n))};
  Eigen::Index at = 0;
  t.values[at++] = 1.0;
  if (order >= SurfaceOrder::linear) {
    for (Eigen::Index j = 0; j < n; ++j, ++at) {
      t.values[at] = u[j];
      t.slopes(j, at) = 1.0;
    }
  }
  if (order >= SurfaceOrder::squares) {
    for (Eigen::Index j = 0; j < n; ++j, ++at) {
      t.values[at] = u[j] * u[j];
      t.slopes(j, at) = 2.0 * u[j];
    }
  }
  if (order < SurfaceOrder::products) return t;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index k = 0; k < j; ++k, ++at) {
      t.values[at] = u[j] * u[k];
      t.slopes(j, at) = u[k];
      t.slopes(k, at) = u[j];
    }
  }
  return t;
}

}  // namespace

double Coordinate::of(double x) const { return logarithmic ? std::log(x) : x / scale; }
double Coordinate::value(double y) const { return logarithmic ? std::exp(y) : y * scale; }
double Coordinate::slope(double x) const { return logarithmic ? 1.0 / x : 1.0 / scale; }

Eigen::Index terms_of(SurfaceOrder order, Eigen::Index n) {
  switch (order) {
    case SurfaceOrder::constant:
      return 1;
    case SurfaceOrder::linear:
      return 1 + n;
    case SurfaceOrder::squares:
      return 1 + 2 * n;
    case SurfaceOrder::products:
      break;
  }
  return 1 + 2 * n + n * (n - 1) / 2;
}

SurfaceOrder order_for(std::size_t count, Eigen::Index n) {
  const auto points = static_cast<Eigen::Index>(count);
  if (n > 1 && points >= terms_of(SurfaceOrder::products, n) + 2) return SurfaceOrder::products;
  if (points >= terms_of(SurfaceOrder::squares, n) + 1) return SurfaceOrder::squares;
  return points >= terms_of(SurfaceOrder::linear, n) + 1 ? SurfaceOrder::linear : SurfaceOrder::constant;
}

ResponseSurface fit_surface(const std::vector<Coordinate>& coordinates, const Eigen::VectorXd& centre,
                            const Eigen::VectorXd& radius, const std::vector<SurfacePoint>& points,
                            SurfaceOrder order) {
  ResponseSurface s{coordinates, centre, radius, order, {}};
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd a(rows, terms_of(order, centre.size()));
  Eigen::MatrixXd b(rows, points.front().values.size());
  for (Eigen::Index k = 0; k < rows; ++k) {
    const SurfacePoint& p = points[static_cast<std::size_t>(k)];
    a.row(k) = terms_at((p.y - centre).cwiseQuotient(radius), order).values;
    b.row(k) = p.values.transpose();
  }
  s.coefficients = a.colPivHouseholderQr().solve(b).transpose();
  return s;
}

Prediction predict(const ResponseSurface& s, const Parameters& parameters, bool derivatives) {
  const auto n = static_cast<Eigen::Index>(s.coordinates.size());
  Eigen::VectorXd u(n), slope(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Coordinate& c = s.coordinates[static_cast<std::size_t>(j)];
    const double x = parameters.*parameter_info[static_cast<std::size_t>(c.place)].member;
    u[j] = (c.of(x) - s.centre[j]) / s.radius[j];
    slope[j] = c.slope(x) / s.radius[j];
    if (s.order != SurfaceOrder::constant && !(std::abs(u[j]) <= surface_reach)) {
      const auto& p = parameter_info[static_cast<std::size_t>(c.place)];
      return failed("the scene was not run near " + std::string(p.name) + " = " +
                    detail::with_unit(x, std::string(p.unit)));
    }
  }
  const Terms t = terms_at(u, s.order);
  Prediction out;
  out.values = s.coefficients * t.values.transpose();
  if (!derivatives) return out;
  out.jacobian = Eigen::MatrixXd::Zero(out.values.size(), parameter_count);
  for (Eigen::Index j = 0; j < n; ++j) {
    out.jacobian.col(s.coordinates[static_cast<std::size_t>(j)].place) =
        slope[j] * (s.coefficients * t.slopes.row(j).transpose());
  }
  return out;
}

}  // namespace fpz::calibration
