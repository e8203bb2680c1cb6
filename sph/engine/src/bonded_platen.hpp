// Particles bonded to the body, with some velocity components driven: rollers, platens, grips (group.hpp).
#pragma once

#include "actuator.hpp"
#include "boundary.hpp"

namespace fpz::sph::detail {

template <int Dim>
class BondedPlaten final : public Boundary<Dim> {
 public:
  /// Of a group of the set-up. Its particles get the prescribed velocity of the start, and no local damping in
  /// driven components.
  BondedPlaten(RunData<Dim>& run, std::size_t group);

  void act(double step) override;
  /// A component that yields keeps the mean of its particles.
  void hold() override;
  void mark_driven(Mask& components) const override;
  /// What the motion of its particles lacks, from their momentum balance: the force of a component that yields; zero in
  /// free components.
  [[nodiscard]] Vec<double, Dim> reaction() const override { return reaction_; }
  [[nodiscard]] Vec<double, Dim> velocity() const override { return velocity_; }
  [[nodiscard]] double stable_step() const override;
  void set_drive(std::size_t component, const Drive& drive) override;
  void steer(std::size_t component, double velocity) override;
  void save(Writer& archive) const override { transfer_state(archive, *this); }
  void load(Reader& archive) override { transfer_state(archive, *this); }

 private:
  template <class Archive, class Self>
  static void transfer_state(Archive& archive, Self& self) {
    archive(self.reaction_);
    archive(self.velocity_);
    for (auto& actuator : self.actuator_) {
      if (actuator) archive(*actuator);
    }
  }

  /// Of its particles at n + 1/2, m/s, from what the body has made of them.
  [[nodiscard]] double next_velocity(std::size_t component, double step) const;

  std::array<std::optional<Actuator>, static_cast<std::size_t>(Dim)> actuator_;
  std::vector<std::size_t> slots_;
  double mass_ = 0.0;                                     ///< kg
  Vec<double, Dim> reaction_ = Vec<double, Dim>::Zero();  ///< at n, N
  Vec<double, Dim> velocity_ = Vec<double, Dim>::Zero();  ///< at n + 1/2, m/s
};

}  // namespace fpz::sph::detail
