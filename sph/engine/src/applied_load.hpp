// Forces on particles in a fixed pattern times a number that changes: pressure and traction on surfaces (group.hpp,
// Load).
#pragma once

#include "boundary.hpp"

namespace fpz::sph::detail {

template <int Dim>
class AppliedLoad final : public Boundary<Dim> {
 public:
  AppliedLoad(RunData<Dim>& run, std::size_t load);

  void push() override;
  void for_pushed(const std::function<void(std::size_t)>& visit) const override {
    for (const Force& f : forces_) visit(f.slot);
  }
  [[nodiscard]] Vec<double, Dim> reaction() const override { return factor_ * sum_; }
  [[nodiscard]] double factor() const override { return factor_; }
  void set_factor(const TimeTable& factor) override { table_ = factor; }
  void save(Writer& archive) const override { transfer_state(archive, *this); }
  void load(Reader& archive) override { transfer_state(archive, *this); }

 private:
  struct Force {
    std::size_t slot;
    Vec<double, Dim> force;  ///< N, at a factor of one
  };

  template <class Archive, class Self>
  static void transfer_state(Archive& archive, Self& self) {
    archive(self.table_);
    archive(self.factor_);
    archive(self.path_);
  }

  std::vector<Force> forces_;
  Vec<double, Dim> sum_ = Vec<double, Dim>::Zero();  ///< of the forces, N
  TimeTable table_;
  double factor_ = 0.0;  ///< at n
  double path_ = 0.0;    ///< J: work that a factor of one would have done from the start to n
};

}  // namespace fpz::sph::detail
