// Fracture energy from the area under a load-deflection curve (RILEM TC 50-FMC 1985), with what weight and tail add
// (Elices, Guinea, Planas 1992, Materials and Structures 25, 327-334).
#pragma once

#include <Eigen/Core>
#include <string>

namespace fpz::calibration {

struct WorkOfFracture {
  double measured = 0.0;  ///< area under the curve, J
  double weight = 0.0;    ///< work of the beam's weight while the curve was measured, J
  double tail = 0.0;      ///< what is spent after the last reading, J
  double energy = 0.0;    ///< all three over the ligament, N/m
  std::string failure;    ///< empty when there is a value
};

/// `deflection` (m) of the load point, growing from about zero; `load` (N). `weight` (N): of the beam between the
/// supports and of what hangs on it, 0 where counterweights or a horizontal test take it away. It acts as a load P_w of
/// half its size at mid-span. Behind the last reading the halves turn about a hinge below the load: the cohesive
/// moment falls with the square of the angle, and with the load P_e and deflection d_e at the end (less the elastic
/// part, along the initial slope) (P_e + P_w) d_e remains to be spent. With P_e = 0 the sum is the RILEM formula
/// W + m g d_e.
[[nodiscard]] WorkOfFracture work_of_fracture(const Eigen::VectorXd& deflection, const Eigen::VectorXd& load,
                                              double ligament_area, double weight);

}  // namespace fpz::calibration
