// An independent reference for the tests: the rate equations of the paper as printed (eq 40-50, 63-67, slips of the
// print repaired), or those of the consistent zone (docs/equations.md), integrated as an ordinary differential equation
// by Dormand and Prince's 5(4) pair with located events. It shares no code with the library: tractions are not scaled,
// traction continuity is not eliminated, onset is a search over planes.
#pragma once

#include <Eigen/Dense>

#include "fpz/parameters.hpp"

namespace fpz::test {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Everything at one instant. Local components: 0 normal, 1 and 2 shear. Before onset only `strain` has meaning.
struct ReferenceState {
  Matrix3 strain = Matrix3::Zero();
  bool cracked = false;
  Matrix3 frame = Matrix3::Identity();  ///< rows n, s1, s2
  Vector3 t = Vector3::Zero();          ///< traction, Pa
  Vector3 u = Vector3::Zero();          ///< jump since onset, m
  Vector3 up = Vector3::Zero();         ///< plastic jump, m
  double slip = 0.0;                    ///< accumulated plastic slip, m
  double integrity = 1.0;               ///< 1 - D
  double dissipated = 0.0;              ///< J/m^2 since onset
};

/// The plane of largest F under a stress, found by search; of equally critical planes the one closest to `hint`.
struct ReferencePlane {
  Vector3 normal;
  double failure_value;  ///< Pa
};

class ReferenceIntegrator {
 public:
  /// In the plane settings strains and hints must have no out-of-plane part; in plane stress only the in-plane stresses
  /// are right.
  ReferenceIntegrator(const Parameters& p, Setting setting, double tolerance = 1e-12);

  /// Moves the strain straight by `dstrain`. `hint` steers the choice between conjugate planes.
  /// Throws std::runtime_error where the rate problem has no unique solution. Works with unscaled tractions: not for a
  /// crack that is separated but for rounding.
  void advance(const Matrix3& dstrain, const Vector3& hint);

  [[nodiscard]] const ReferenceState& state() const { return s_; }
  [[nodiscard]] Matrix3 stress() const;
  /// F of the monotone form of eq 48 on a plane, undamaged.
  [[nodiscard]] double failure_value(const Matrix3& stress, const Vector3& normal) const;
  [[nodiscard]] ReferencePlane critical_plane(const Matrix3& stress, const Vector3& hint) const;
  [[nodiscard]] Matrix3 elastic_stress(const Matrix3& strain) const;

 private:
  static constexpr int size = 12;  ///< t, u, up, slip, integrity, dissipated
  using Y = Eigen::Matrix<double, size, 1>;
  struct Mode {
    bool plastic = false;
    bool tension = true;
    double shear_sign = 0.0;  ///< 2-D only: sign of the one shear traction
    int piece = 0;            ///< of the softening curve
  };
  struct Derivatives {
    Y rate;
    double multiplier;  ///< d(lambda): must stay positive while plastic
  };

  [[nodiscard]] Y pack() const;
  void unpack(const Y& y);
  [[nodiscard]] Derivatives rates(const Y& y, const Mode& mode) const;
  [[nodiscard]] Derivatives published_rates(const Y& y, const Mode& mode) const;
  [[nodiscard]] Derivatives consistent_rates(const Y& y, const Mode& mode) const;
  [[nodiscard]] Y step(const Y& y, double h, const Mode& mode, Y* error) const;
  [[nodiscard]] double yield(const Vector3& t, double w) const;
  /// -dw/d(kappa) on a piece of the softening curve, 1/m, and the w at which the piece ends (negative: never).
  [[nodiscard]] double fall(double w, int piece) const;
  [[nodiscard]] double piece_end(int piece) const;
  [[nodiscard]] double elastic_exit(const Y& y, const Mode& mode) const;
  [[nodiscard]] double event(const Y& y, const Mode& mode, int which) const;
  void open(const Matrix3& dstrain, const Vector3& hint, double& x);
  void elastic_phase(double& x);
  void plastic_phase(double& x);
  [[nodiscard]] Mode current_mode(const Y& y) const;
  [[nodiscard]] Vector3 gradient(const Matrix3& stress, const Vector3& n) const;
  [[nodiscard]] Vector3 polish(const Matrix3& stress, Vector3 n) const;

  Parameters p_;
  Setting setting_;
  double tolerance_;
  double lambda_, mu_, tan_phi_, tan_psi_;
  bool bilinear_;    ///< Petersson's softening; else the exponential one
  bool consistent_;  ///< the consistent zone; else the published one
  ReferenceState s_;
  bool unloading_ = false;           ///< the last phase ended where plastic loading did
  Vector3 drive_ = Vector3::Zero();  ///< local traction rate of the uncracked bulk, Pa per unit of the increment
};

}  // namespace fpz::test
