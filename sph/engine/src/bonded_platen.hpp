// Particles bonded to the body, with some velocity components prescribed: rollers, platens, grips (group.hpp).
#pragma once

#include "boundary.hpp"

namespace fpz::sph::detail {

template <int Dim>
class BondedPlaten final : public Boundary<Dim> {
 public:
  /// Of a group of the set-up. Its particles get the prescribed velocity of the start, and no local damping in
  /// prescribed components.
  BondedPlaten(RunData<Dim>& run, std::size_t group);

  void act(double step) override;
  void hold() override;
  /// What the motion of its particles lacks, from their momentum balance; zero in free components.
  [[nodiscard]] Vec<double, Dim> reaction() const override { return reaction_; }
  void save(Writer& archive) const override { transfer_state(archive, *this); }
  void load(Reader& archive) override { transfer_state(archive, *this); }

 private:
  struct Component {
    std::size_t slot;
    std::size_t component;
  };

  template <class Archive, class Self>
  static void transfer_state(Archive& archive, Self& self) {
    archive(self.reaction_);
    archive(self.velocity_);
  }

  /// Of a prescribed component at n + 1/2, m/s.
  [[nodiscard]] double prescribed_velocity(std::size_t component) const {
    return motion_[component]->velocity(this->run_.now() + 0.5 * this->run_.dt);
  }

  std::array<std::optional<Motion>, static_cast<std::size_t>(Dim)> motion_;
  std::vector<Component> prescribed_;
  Vec<double, Dim> reaction_ = Vec<double, Dim>::Zero();  ///< at n, N
  Vec<double, Dim> velocity_ = Vec<double, Dim>::Zero();  ///< at n + 1/2, m/s
};

}  // namespace fpz::sph::detail
