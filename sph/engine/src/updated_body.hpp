// The paper's form: bonds and kernel gradients of the present positions. The neighbour lists have a skin and are made
// anew only when something moved far enough. Strain is that of the last step, stress is turned along (objective rate).
#pragma once

#include "body.hpp"

namespace fpz::sph::detail {

template <int Dim>
class UpdatedBody final : public Body<Dim> {
 public:
  explicit UpdatedBody(RunData<Dim>& run);

  void start() override;
  [[nodiscard]] Outcome advance(const Kick& kick) override;
  void save(Writer& archive) const override { transfer_state(archive, *this); }
  void load(Reader& archive) override;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"built_at", Extent::particle, Keep::saved}, self.built_at_, nullptr);
  }

 protected:
  [[nodiscard]] const Fields<Dim>& bond_positions() const override { return this->run_.particles.position; }
  [[nodiscard]] Tensor<double, Dim> strain_increment(std::size_t i, const State<double, Dim>&) const override;
  void turn(std::size_t i, State<double, Dim>& point) const override;
  void set_flux(std::size_t i, const Symmetric& stress) override;

 private:
  /// Lists from the present positions.
  void rebuild();
  /// Whether two particles outside each other's lists may have come within the support of the kernel.
  [[nodiscard]] bool outdated() const;

  template <class Archive, class Self>
  static void transfer_state(Archive& archive, Self& self) {
    Body<Dim>::transfer_lists(archive, self);
    fields(self, Transfer<Archive>{archive});
  }

  Fields<Dim> built_at_;  ///< positions when the lists were made
};

}  // namespace fpz::sph::detail
