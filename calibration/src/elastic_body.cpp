#include "fpz/calibration/elastic_body.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fpz::calibration {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ElementMatrix = Eigen::Matrix<double, 16, 16>;

/// In-plane Lame constants at E = 1 and their derivatives with respect to nu.
struct Lame {
  double lambda, mu, d_lambda, d_mu;
};

Lame lame(Setting setting, double nu) {
  Lame c{};
  c.mu = 0.5 / (1.0 + nu);
  c.d_mu = -0.5 / ((1.0 + nu) * (1.0 + nu));
  if (setting == Setting::plane_stress) {
    const double q = 1.0 - nu * nu;
    c.lambda = nu / q;
    c.d_lambda = (1.0 + nu * nu) / (q * q);
  } else {
    const double q = (1.0 + nu) * (1.0 - 2.0 * nu);
    c.lambda = nu / q;
    c.d_lambda = (1.0 + 2.0 * nu * nu) / (q * q);
  }
  return c;
}

/// Derivatives of the shape functions of the eight-node quadrilateral in its own coordinates, one node per column.
Eigen::Matrix<double, 2, 8> shape_gradients(double r, double s) {
  constexpr std::array<double, 8> rs = {-1, 1, 1, -1, 0, 1, 0, -1};
  constexpr std::array<double, 8> ss = {-1, -1, 1, 1, -1, 0, 1, 0};
  Eigen::Matrix<double, 2, 8> g;
  for (int k = 0; k < 8; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double a = rs[i];
    const double b = ss[i];
    if (k < 4) {
      g(0, k) = 0.25 * a * (1.0 + b * s) * (2.0 * a * r + b * s);
      g(1, k) = 0.25 * b * (1.0 + a * r) * (2.0 * b * s + a * r);
    } else if (a == 0.0) {
      g(0, k) = -r * (1.0 + b * s);
      g(1, k) = 0.5 * b * (1.0 - r * r);
    } else {
      g(0, k) = 0.5 * a * (1.0 - s * s);
      g(1, k) = -s * (1.0 + a * r);
    }
  }
  return g;
}

/// Stiffness of an element for lambda = 1, mu = 0 and for lambda = 0, mu = 1.
struct ElementPair {
  ElementMatrix lambda = ElementMatrix::Zero();
  ElementMatrix mu = ElementMatrix::Zero();
};

ElementPair element_stiffness(const HalfMesh& mesh, const std::array<int, 8>& element) {
  // Two points each way: a point more makes the element stiffer and the results worse at the same mesh.
  static const double point = 1.0 / std::sqrt(3.0);
  Eigen::Matrix<double, 8, 2> x;
  for (int k = 0; k < 8; ++k)
    x.row(k) = mesh.nodes[static_cast<std::size_t>(element[static_cast<std::size_t>(k)])].transpose();
  ElementPair out;
  for (const double r : {-point, point}) {
    for (const double s : {-point, point}) {
      const Eigen::Matrix<double, 2, 8> local = shape_gradients(r, s);
      const Eigen::Matrix2d jacobian = local * x;
      const double weight = jacobian.determinant() * mesh.thickness;
      const Eigen::Matrix<double, 2, 8> g = jacobian.inverse() * local;
      Eigen::Matrix<double, 3, 16> b = Eigen::Matrix<double, 3, 16>::Zero();  // xx, yy, engineering xy
      for (int k = 0; k < 8; ++k) {
        b(0, 2 * k) = b(2, 2 * k + 1) = g(0, k);
        b(1, 2 * k + 1) = b(2, 2 * k) = g(1, k);
      }
      const Eigen::Matrix<double, 1, 16> trace = b.row(0) + b.row(1);
      out.lambda.noalias() += weight * trace.transpose() * trace;
      b.topRows<2>() *= std::sqrt(2.0);
      out.mu.noalias() += weight * b.transpose() * b;
    }
  }
  return out;
}

/// Which degrees of freedom (2 node + direction) survive the condensation, and the order of all of them.
struct Numbering {
  std::vector<int> position;  ///< of every degree of freedom; -1: held
  int interior = 0;           ///< number of eliminated ones, which come first
  std::vector<int> kept;      ///< degrees of freedom behind them, ligament openings first
  int ligament = 0;           ///< number of ligament openings
};

int horizontal(int node) { return 2 * node; }
int vertical(int node) { return 2 * node + 1; }

int mid_line_node(const HalfMesh& mesh, int k) { return mesh.mid_line[static_cast<std::size_t>(k)]; }

double height_of(const HalfMesh& mesh, int k) {
  return mesh.nodes[static_cast<std::size_t>(mid_line_node(mesh, k))].y();
}

/// Horizontal displacement of the flank a distance before the mouth. Knife edges turn with the face, which stays square
/// to the flank: u_x(-d) = u_x - d du_x/dy at the mouth.
std::vector<NodeShare> flank_gauge(const HalfMesh& mesh, double distance) {
  const double h = height_of(mesh, 2) - height_of(mesh, 0);
  const std::array<double, 3> slope = {-3.0 / h, 4.0 / h, -1.0 / h};
  std::vector<NodeShare> out;
  for (int k = 0; k < 3; ++k) {
    out.push_back({mid_line_node(mesh, k), (k == 0 ? 1.0 : 0.0) - distance * slope[static_cast<std::size_t>(k)]});
  }
  return out;
}

/// Horizontal displacement of the flank on the line of the forces, where there is one.
std::vector<NodeShare> load_line_gauge(const HalfMesh& mesh) {
  if (!mesh.load_line) return {};
  const double distance = height_of(mesh, 0) - *mesh.load_line;
  if (distance >= 0.0) return flank_gauge(mesh, distance);
  int nearest = 0;
  for (int k = 0; k < mesh.tip; ++k) {
    const auto off = [&](int i) { return std::abs(height_of(mesh, i) - *mesh.load_line); };
    if (off(k) < off(nearest)) nearest = k;
  }
  return {{mid_line_node(mesh, nearest), 1.0}};
}

std::vector<int> kept_freedoms(const HalfMesh& mesh) {
  std::vector<int> kept;
  const auto add = [&kept](int freedom) {
    if (std::find(kept.begin(), kept.end(), freedom) == kept.end()) kept.push_back(freedom);
  };
  for (int k = mesh.tip; k < static_cast<int>(mesh.mid_line.size()); ++k) add(horizontal(mid_line_node(mesh, k)));
  for (const NodeShare& s : flank_gauge(mesh, 0.0)) add(horizontal(s.node));
  for (const NodeShare& s : load_line_gauge(mesh)) add(horizontal(s.node));
  if (!mesh.support.empty()) add(vertical(mesh.mid_depth));
  for (const NodeForce& f : mesh.forces) {
    if (f.force.x() != 0.0) add(horizontal(f.node));
    if (f.force.y() != 0.0) add(vertical(f.node));
  }
  const auto held = std::find(kept.begin(), kept.end(), vertical(mesh.held));
  if (held != kept.end()) kept.erase(held);
  return kept;
}

/// Fill-reducing order of the nodes of the mesh (approximate minimum degree).
std::vector<int> node_order(const HalfMesh& mesh) {
  std::vector<Triplet> pairs;
  pairs.reserve(mesh.elements.size() * 28);
  for (const auto& e : mesh.elements) {
    for (const int i : e) {
      for (const int j : e) {
        if (i >= j) pairs.emplace_back(i, j, 1.0);
      }
    }
  }
  const auto n = static_cast<Eigen::Index>(mesh.nodes.size());
  SparseMatrix graph(n, n);
  graph.setFromTriplets(pairs.begin(), pairs.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().data(), order.indices().data() + n};
}

Numbering number(const HalfMesh& mesh) {
  constexpr int unset = -2;
  Numbering out;
  out.kept = kept_freedoms(mesh);
  out.ligament = static_cast<int>(mesh.mid_line.size()) - mesh.tip;
  out.position.assign(2 * mesh.nodes.size(), unset);
  for (const int freedom : out.kept) out.position[static_cast<std::size_t>(freedom)] = 0;
  out.position[static_cast<std::size_t>(vertical(mesh.held))] = -1;
  for (const int node : node_order(mesh)) {
    for (const int freedom : {horizontal(node), vertical(node)}) {
      int& p = out.position[static_cast<std::size_t>(freedom)];
      if (p == unset) p = out.interior++;
    }
  }
  for (std::size_t k = 0; k < out.kept.size(); ++k) {
    out.position[static_cast<std::size_t>(out.kept[k])] = out.interior + static_cast<int>(k);
  }
  return out;
}

/// Lower triangle of the stiffness at E = 1 in the order of `numbering` and, where wanted, its derivative.
struct Stiffness {
  SparseMatrix value;
  SparseMatrix d_nu;
};

Stiffness assemble(const HalfMesh& mesh, const Numbering& numbering, const Lame& c, bool derivative) {
  std::vector<Triplet> value;
  std::vector<Triplet> slope;
  value.reserve(mesh.elements.size() * 136);
  if (derivative) slope.reserve(mesh.elements.size() * 136);
  for (const auto& element : mesh.elements) {
    const ElementPair pair = element_stiffness(mesh, element);
    std::array<int, 16> place{};
    for (std::size_t k = 0; k < 8; ++k) {
      place[2 * k] = numbering.position[static_cast<std::size_t>(horizontal(element[k]))];
      place[2 * k + 1] = numbering.position[static_cast<std::size_t>(vertical(element[k]))];
    }
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 16; ++i) {
        const int row = place[static_cast<std::size_t>(i)];
        const int column = place[static_cast<std::size_t>(j)];
        if (column < 0 || row < column) continue;
        value.emplace_back(row, column, c.lambda * pair.lambda(i, j) + c.mu * pair.mu(i, j));
        if (derivative) slope.emplace_back(row, column, c.d_lambda * pair.lambda(i, j) + c.d_mu * pair.mu(i, j));
      }
    }
  }
  const Eigen::Index n = numbering.interior + static_cast<Eigen::Index>(numbering.kept.size());
  Stiffness out;
  out.value.resize(n, n);
  out.value.setFromTriplets(value.begin(), value.end());
  if (derivative) {
    out.d_nu.resize(n, n);
    out.d_nu.setFromTriplets(slope.begin(), slope.end());
  }
  return out;
}

using Factor = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;

/// Stiffness of the kept degrees of freedom: they come last, so it is what the factorisation has left there.
Eigen::MatrixXd schur_complement(const Factor& factor, int interior) {
  const SparseMatrix& l = factor.matrixL().nestedExpression();
  const Eigen::Index m = l.cols() - interior;
  Eigen::MatrixXd lower = Eigen::MatrixXd::Identity(m, m);
  for (Eigen::Index j = 0; j < m; ++j) {
    for (SparseMatrix::InnerIterator it(l, interior + j); it; ++it) lower(it.row() - interior, j) = it.value();
  }
  return lower * factor.vectorD().tail(m).asDiagonal() * lower.transpose();
}

/// Displacements of the whole half body, in the order of the factor, for given kept ones: L_ii^T x_i = -L_bi^T x_b.
RowMajor displacements(const Factor& factor, const Eigen::MatrixXd& kept) {
  const SparseMatrix& l = factor.matrixL().nestedExpression();
  const Eigen::Index interior = l.cols() - kept.rows();
  RowMajor x = RowMajor::Zero(l.cols(), kept.cols());
  x.bottomRows(kept.rows()) = kept;
  for (Eigen::Index j = interior - 1; j >= 0; --j) {
    for (SparseMatrix::InnerIterator it(l, j); it; ++it) {
      if (it.row() > j) x.row(j) -= it.value() * x.row(it.row());
    }
  }
  return x;
}

/// Loads per unit of P and gauges, as vectors on the kept degrees of freedom behind the ligament.
struct Functionals {
  Eigen::VectorXd load;
  Eigen::MatrixXd gauges;  ///< one per column
};

Functionals functionals(const HalfMesh& mesh, const Numbering& numbering, double clip_distance) {
  const Eigen::Index m = static_cast<Eigen::Index>(numbering.kept.size()) - numbering.ligament;
  Functionals out{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, gauge_count)};
  const auto add = [&](auto&& column, int freedom, double factor) {
    const int place = numbering.position[static_cast<std::size_t>(freedom)];
    if (place >= 0) column[place - numbering.interior - numbering.ligament] += factor;
  };
  auto cmod = out.gauges.col(static_cast<int>(Gauge::cmod));
  auto mid = out.gauges.col(static_cast<int>(Gauge::deflection_mid_depth));
  auto loaded = out.gauges.col(static_cast<int>(Gauge::deflection_load_point));
  auto on_load_line = out.gauges.col(static_cast<int>(Gauge::load_line_opening));
  for (const NodeForce& f : mesh.forces) {
    for (const auto& [freedom, force] :
         {std::pair{horizontal(f.node), f.force.x()}, std::pair{vertical(f.node), f.force.y()}}) {
      if (force == 0.0) continue;
      add(out.load, freedom, force);
      add(loaded, freedom, 2.0 * force);
    }
  }
  for (const NodeShare& s : mesh.support) add(mid, vertical(s.node), s.share);
  if (!mesh.support.empty()) add(mid, vertical(mesh.mid_depth), -1.0);
  if (mesh.tip == 0) return out;
  for (const NodeShare& s : flank_gauge(mesh, clip_distance)) add(cmod, horizontal(s.node), 2.0 * s.share);
  for (const NodeShare& s : load_line_gauge(mesh)) add(on_load_line, horizontal(s.node), 2.0 * s.share);
  return out;
}

/// Derivatives of the four maps from the form U^T (dK/dnu) U on the displacement fields of the basis.
CondensedBody derivative_blocks(const Eigen::MatrixXd& form, Eigen::Index n) {
  CondensedBody out;
  out.stiffness = 2.0 * form.topLeftCorner(n, n);
  out.load = -2.0 * form.col(n).head(n);
  out.gauge_jump = -form.bottomLeftCorner(gauge_count, n);
  out.gauge_load = -form.col(n).tail(gauge_count);
  return out;
}

}  // namespace

Condensation condense(const HalfMesh& mesh, Setting setting, double poisson_ratio, double clip_distance,
                      bool nu_derivative) {
  const Numbering numbering = number(mesh);
  const Stiffness stiffness = assemble(mesh, numbering, lame(setting, poisson_ratio), nu_derivative);
  Factor factor(stiffness.value);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the stiffness of the elastic body is singular");

  // 1. Basis on the kept degrees of freedom: half a unit jump of each ligament node with the others free, the load
  //    with the ligament tied, and a force along each gauge with the ligament tied.
  const int n = numbering.ligament;
  const Eigen::MatrixXd s = schur_complement(factor, numbering.interior);
  const Eigen::Index m = s.rows() - n;
  const Functionals f = functionals(mesh, numbering, clip_distance);
  const Eigen::LDLT<Eigen::MatrixXd> free_part(s.bottomRightCorner(m, m));
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n + m, n + 1 + gauge_count);
  basis.topLeftCorner(n, n).diagonal().setConstant(0.5);
  basis.bottomLeftCorner(m, n) = free_part.solve(-0.5 * s.bottomLeftCorner(m, n));
  basis.col(n).tail(m) = free_part.solve(f.load);
  basis.bottomRightCorner(m, gauge_count) = free_part.solve(f.gauges);

  // 2. The four maps. Each half moves by half the jump, and carries half the load.
  Condensation out;
  CondensedBody& b = out.body;
  b.stiffness = 2.0 * basis.leftCols(n).transpose() * s * basis.leftCols(n);
  b.load = 2.0 * basis.bottomLeftCorner(m, n).transpose() * f.load;
  b.gauge_jump = f.gauges.transpose() * basis.bottomLeftCorner(m, n);
  b.gauge_load = f.gauges.transpose() * basis.col(n).tail(m);

  if (mesh.tip == 0) b.gauge_jump(static_cast<int>(Gauge::cmod), 0) = 1.0;

  // 3. A compliance B^T K^-1 B has the derivative -U^T (dK/dnu) U, U = K^-1 B; so have its blocks after elimination.
  if (nu_derivative) {
    const RowMajor u = displacements(factor, basis);
    const RowMajor force = stiffness.d_nu.selfadjointView<Eigen::Lower>() * u;
    out.d_nu = derivative_blocks(u.transpose() * force, n);
  }

  // 4. Integration along the ligament: Simpson's rule on the quadratic sides.
  out.height.resize(n);
  out.area = Eigen::VectorXd::Zero(n);
  for (int k = 0; k < n; ++k)
    out.height[k] = mesh.nodes[static_cast<std::size_t>(mid_line_node(mesh, mesh.tip + k))].y();
  for (int k = 0; k + 2 < n; k += 2) {
    const double sixth = mesh.thickness * (out.height[k + 2] - out.height[k]) / 6.0;
    out.area[k] += sixth;
    out.area[k + 1] += 4.0 * sixth;
    out.area[k + 2] += sixth;
  }
  return out;
}

}  // namespace fpz::calibration
