// A rigid platen on a hinge: it turns freely about one of its points, whose components are driven or free (group.hpp,
// Group::hinge). Rollers under a beam, spherical seats.
#pragma once

#include <Eigen/Core>

#include "actuator.hpp"
#include "boundary.hpp"

namespace fpz::sph::detail {

template <int Dim>
class HingedPlaten final : public Boundary<Dim> {
 public:
  /// Of a group of the set-up that has a hinge. Free components of the hinge are driven by a force of zero.
  HingedPlaten(RunData<Dim>& run, std::size_t group);

  void act(double step) override;
  void hold() override;
  void mark_driven(Mask& components) const override {
    for (const std::size_t i : slots_) components[i] = (1U << Dim) - 1U;
  }
  /// Of the hinge, which carries no moment.
  [[nodiscard]] Vec<double, Dim> reaction() const override { return reaction_; }
  [[nodiscard]] Vec<double, Dim> velocity() const override { return motion_.template head<Dim>(); }
  [[nodiscard]] double stable_step() const override;
  void set_drive(std::size_t component, const Drive& drive) override;
  void steer(std::size_t component, double velocity) override { actuator_[component].steered = velocity; }
  void save(Writer& archive) const override { transfer_state(archive, *this); }
  void load(Reader& archive) override { transfer_state(archive, *this); }

 private:
  /// Velocity of the hinge, m/s, and rate of rotation, rad/s, counter-clockwise.
  using Rigid = Eigen::Matrix<double, Dim + 1, 1, Eigen::DontAlign>;

  template <class Archive, class Self>
  static void transfer_state(Archive& archive, Self& self) {
    archive(self.reaction_);
    archive(self.motion_);
    archive(self.hinge_);
    archive(self.actuator_);
  }

  /// The rigid motion with the momentum of the particles, and that of `impulse` on the hinge (N s), where `prescribed`
  /// components of the hinge have their velocity.
  [[nodiscard]] Rigid rigid_motion(const Vec<double, Dim>& impulse,
                                   const std::array<std::optional<double>, 2>& prescribed) const;
  /// Velocity of a particle, m/s.
  [[nodiscard]] Vec<double, Dim> velocity_at(std::size_t slot, const Rigid& motion) const;

  std::array<Actuator, static_cast<std::size_t>(Dim)> actuator_;
  std::vector<std::size_t> slots_;
  double mass_ = 0.0;                                     ///< kg
  Vec<double, Dim> hinge_;                                ///< at n, m
  Vec<double, Dim> reaction_ = Vec<double, Dim>::Zero();  ///< at n, N
  Rigid motion_ = Rigid::Zero();                          ///< at n + 1/2
};

}  // namespace fpz::sph::detail
