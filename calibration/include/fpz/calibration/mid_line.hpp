// A straight crack along the ligament of a condensed elastic body: one cohesive zone per ligament node, in pure mode I,
// and the path of equilibrium under a prescribed displacement of a gauge.
//
// A node is tied until its traction reaches sigma_t0; from then on the cohesive law of the library holds between its
// traction and its jump, unloading and closing included. Unknowns are the jumps of the cracked nodes and the load.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <string>
#include <vector>

#include "fpz/calibration/elastic_body.hpp"
#include "fpz/law/cohesive_law.hpp"
#include "fpz/state.hpp"

namespace fpz::calibration {

/// What a path is differentiated with respect to.
enum class PathInput : int {
  young_modulus,
  poisson_ratio,
  tensile_strength,
  delta0,
  normal_stiffness,
  gauge_offset,
  machine_compliance
};
inline constexpr int path_input_count = 7;

/// The reading that is prescribed: reading = gauge + offset + machine_compliance * P + toe (1 - exp(-Q/toe_load)).
struct Control {
  Gauge gauge = Gauge::cmod;
  double offset = 0.0;              ///< m
  double machine_compliance = 0.0;  ///< m/N, >= 0
  /// Rollers and contacts settle by up to `toe` while the load first rises; Q is the largest load so far. Known to
  /// monotonic_curve() only.
  double toe = 0.0;       ///< m, >= 0
  double toe_load = 0.0;  ///< N, > 0 where there is a toe
};

/// Cohesive crack on one condensed body. Copies nothing: body and parameters must outlive it.
class MidLine {
 public:
  /// A number with its derivatives: with respect to the inputs, and to the node's own jump (last).
  using Slope = Dual<path_input_count + 1>;

  /// `derivatives` needs condensation.d_nu.
  MidLine(const Condensation& condensation, const Parameters& parameters, const Control& control, bool derivatives);

  /// Moves the reading to `reading` (m) in as many steps as that takes. Returns why that is impossible, or an empty
  /// string; after a failure the state is the last one that was reached.
  [[nodiscard]] std::string advance(double reading);

  [[nodiscard]] double reading() const { return now_.reading; }
  [[nodiscard]] double load() const { return now_.load; }  ///< P, N
  [[nodiscard]] double gauge(Gauge which) const;           ///< m
  /// Full opening of the ligament nodes, m.
  [[nodiscard]] const Eigen::VectorXd& jump() const { return now_.jump; }
  /// Closing traction of the ligament nodes, Pa; of tied nodes from equilibrium.
  [[nodiscard]] Eigen::VectorXd traction() const;
  /// Change of the jumps per change of the reading in equilibrium.
  [[nodiscard]] const Eigen::VectorXd& jump_rate() const { return now_.jump_rate; }
  /// dP at fixed reading per unit of each PathInput.
  [[nodiscard]] const Eigen::VectorXd& load_derivatives() const { return now_.load_derivatives; }
  /// Work done on the crack since the beginning, J: dissipated energy plus what the springs Kn and Ks have stored.
  [[nodiscard]] double fracture_work() const;
  /// Energy of the elastic body, J.
  [[nodiscard]] double elastic_energy() const;
  /// Distance from the notch tip to the highest cracked node, m.
  [[nodiscard]] double crack_length() const;
  /// Reading at which the first node cracks, m.
  [[nodiscard]] double elastic_limit() const;

 private:
  static constexpr int own_jump = path_input_count;  ///< seed of the node's own jump
  using Zone = CohesiveState<double, 1>;
  using SlopeZone = CohesiveState<Slope, 1>;

  /// A state of equilibrium.
  struct State {
    double reading = 0.0;
    double load = 0.0;
    double load_rate = 0.0;
    Eigen::VectorXd jump;
    Eigen::VectorXd jump_rate;
    std::vector<bool> cracked;
    std::vector<Zone> zones;
    std::vector<SlopeZone> slopes;  ///< zones with their derivatives at fixed reading; empty without derivatives
    Eigen::VectorXd load_derivatives;
  };

  /// Equations of the cracked nodes: residual = load P - stiffness w - area t.
  struct System {
    std::vector<Eigen::Index> nodes;
    Eigen::MatrixXd stiffness;  ///< E times the condensed stiffness, N/m
    Eigen::VectorXd load;       ///< force per P
    Eigen::VectorXd gauge;      ///< gauge per jump
    Eigen::VectorXd area;       ///< m^2
    Eigen::VectorXd jump;       ///< m
    std::vector<Zone> zones;
    Eigen::VectorXd tangent;  ///< dt/dw, Pa/m
    Eigen::VectorXd residual;
    double gauge_residual = 0.0;
    double error = 0.0;  ///< largest residual over area sigma_t0
  };

  [[nodiscard]] bool step_to(double reading, State& next);
  [[nodiscard]] System make_system(const State& state) const;
  [[nodiscard]] bool newton(State& next, System& system);
  [[nodiscard]] bool evaluate(const State& next, System& system);
  void factorise(const System& system);
  [[nodiscard]] bool change_set(State& next, const System& system) const;
  void set_rates(State& next, const System& system) const;
  [[nodiscard]] bool close_to_prediction(const State& next) const;
  [[nodiscard]] bool differentiate(State& next, const System& system);
  [[nodiscard]] std::string why_stuck(double wanted) const;

  const Condensation& body_;
  double young_modulus_;
  Control control_;
  bool derivatives_;
  CohesiveLaw<double> law_;
  CohesiveLaw<Slope> slope_law_;
  Eigen::MatrixXd stiffness_;  ///< E times the condensed one, N/m
  double reading_per_load_;    ///< with the crack closed, m/N
  State now_;
  double largest_load_ = 0.0;
  int steps_ = 0;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;  ///< of the last tangent with the load eliminated
  bool unique_ = true;                       ///< its determinant is positive
  Status law_status_ = Status::ok;
};

}  // namespace fpz::calibration
