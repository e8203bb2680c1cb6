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

/// One half (x >= 0) of a specimen that is symmetric about x = 0, in eight-node quadrilaterals. The face with the notch
/// is at y = 0, the load comes from above.
struct HalfMesh {
  std::vector<Eigen::Vector2d> nodes;  ///< m
  std::vector<std::array<int, 8>>
      elements;               ///< four corners counterclockwise, then the sides' middles from corner 0 on
  std::vector<int> mid_line;  ///< nodes on x = 0 from the face upwards, corners and middles in turn
  /// Index in mid_line of the notch tip, even and at least 4, or 0 without a notch; the ligament starts there.
  int tip = 0;
  int mid_depth = 0;  ///< node on the mid-line at half depth
  std::vector<NodeShare> load;
  std::vector<NodeShare> support;
  double thickness = 0.0;  ///< m
};

/// Measured displacements, in the order of the rows of CondensedBody::gauge_jump.
enum class Gauge : int {
  /// Opening of the notch at its mouth (or at the clip gauge below it), m. Without a notch the opening of the crack at
  /// the face.
  cmod,
  deflection_mid_depth,   ///< of the mid-line at half depth, relative to the supports, downwards, m
  deflection_load_point,  ///< of the load, relative to the supports, downwards, m: its work is P d(deflection)
};
inline constexpr int gauge_count = 3;

}  // namespace fpz::calibration

/// As columns of data name them.
template <>
struct fpz::Words<fpz::calibration::Gauge> {
  using K = calibration::Gauge;
  static constexpr Word<K> list[] = {
      {K::cmod, "cmod"}, {K::deflection_load_point, "deflection"}, {K::deflection_mid_depth, "deflection_mid_depth"}};
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

/// Condenses the half body. `clip_distance` (m): the gauge sits on knife edges that far below the face.
[[nodiscard]] Condensation condense(const HalfMesh& mesh, Setting setting, double poisson_ratio, double clip_distance,
                                    bool nu_derivative);

}  // namespace fpz::calibration
