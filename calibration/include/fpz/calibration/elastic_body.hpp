// The elastic half of a symmetric notched specimen, condensed onto the jumps of its mid-line.
//
// The specimen is cut along its plane of symmetry. What the uncut rest of that plane, the ligament, has to know about
// the elastic body are four linear maps between the jumps w of the ligament nodes (full opening of both halves), the
// load P, the closing tractions t of the nodes and the gauges d:
//     area t = load P - E stiffness w,        d = gauge_jump w + gauge_load P / E.
// All of them depend on the geometry and on Poisson's ratio only; Young's modulus enters as written.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "fpz/types.hpp"

namespace fpz::calibration {

/// A node with its share of a force or of a mean displacement; shares of one list sum to one.
struct NodeShare {
  int node = 0;
  double share = 0.0;
};

/// A force on a node of the half, over the load P of the whole specimen.
struct NodeForce {
  int node = 0;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
};

/// One half (x >= 0) of a specimen that is symmetric about x = 0, in eight-node quadrilaterals. The notch comes from
/// below, in the direction of y. Between the forces and what the ligament carries the half is in equilibrium.
struct HalfMesh {
  std::vector<Eigen::Vector2d> nodes;  ///< m
  std::vector<std::array<int, 8>>
      elements;               ///< four corners counterclockwise, then the sides' middles from corner 0 on
  std::vector<int> mid_line;  ///< nodes on x = 0 from the mouth of the notch up, corners and middles in turn
  /// Index in mid_line of the notch tip, even and at least 4, or 0 without a notch; the ligament starts there.
  int tip = 0;
  std::vector<NodeForce> forces;    ///< on the half; what they have in y is in equilibrium, or is taken by `held`
  int held = 0;                     ///< node that does not move in y: it takes the rigid motion
  std::vector<NodeShare> support;   ///< of beams and half discs: what deflections are relative to; otherwise empty
  int mid_depth = 0;                ///< of beams and half discs: node on the mid-line at half depth
  std::optional<double> load_line;  ///< of specimens that are pulled open: height of the line of the forces, m
  double thickness = 0.0;           ///< m
};

/// Measured displacements, in the order of the rows of CondensedBody::gauge_jump.
enum class Gauge : int {
  /// Opening of the notch at its mouth (or at the clip gauge below it), m. Without a notch the opening of the crack at
  /// the face.
  cmod,
  deflection_mid_depth,  ///< of the mid-line at half depth, relative to the supports, downwards, m
  /// Of the load, relative to the supports, downwards, m; of specimens that are pulled open, what the points of the two
  /// forces move apart. Its work is P d(deflection).
  deflection_load_point,
  /// Of specimens that are pulled open: opening of the notch on the line of the forces, m. Where that line lies before
  /// the mouth, the flanks go on straight.
  load_line_opening,
};
inline constexpr int gauge_count = 4;

/// Across the notch, without supports or machine in between.
[[nodiscard]] inline bool is_opening(Gauge gauge) { return gauge == Gauge::cmod || gauge == Gauge::load_line_opening; }

}  // namespace fpz::calibration

/// As columns of data name them.
template <>
struct fpz::Words<fpz::calibration::Gauge> {
  using K = calibration::Gauge;
  static constexpr Word<K> list[] = {{K::cmod, "cmod"},
                                     {K::deflection_load_point, "deflection"},
                                     {K::deflection_mid_depth, "deflection_mid_depth"},
                                     {K::load_line_opening, "load_line_opening"}};
};

namespace fpz::calibration {

/// The four maps at E = 1 Pa; also used for their derivatives with respect to nu. n ligament nodes from the notch tip
/// up.
struct CondensedBody {
  Eigen::MatrixXd stiffness;   ///< n x n, symmetric, m
  Eigen::VectorXd load;        ///< n, closing force of the node per load
  Eigen::MatrixXd gauge_jump;  ///< gauge_count x n
  Eigen::VectorXd gauge_load;  ///< gauge_count, 1/m
};

struct Condensation {
  CondensedBody body;
  std::optional<CondensedBody> d_nu;  ///< exact derivatives with respect to Poisson's ratio, where asked for
  Eigen::VectorXd height;             ///< of the ligament nodes above the face, m
  Eigen::VectorXd area;               ///< of the ligament that each node stands for, m^2
};

/// Condenses the half body. `clip_distance` (m): the gauge sits on knife edges that far before the mouth of the notch.
[[nodiscard]] Condensation condense(const HalfMesh& mesh, Setting setting, double poisson_ratio, double clip_distance,
                                    bool nu_derivative);

}  // namespace fpz::calibration
