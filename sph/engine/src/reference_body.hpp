// Total Lagrangian: bonds and their vectors in the undeformed body, built once, cut where a crack has fully opened.
// Strain is U - I of the deformation gradient, stress stays in the frame that turns with the particle.
#pragma once

#include <optional>

#include "body.hpp"
#include "bond_rows.hpp"
#include "crack_bands.hpp"
#include "crack_rows.hpp"

namespace fpz::sph::detail {

template <int Dim>
class ReferenceBody final : public Body<Dim> {
 public:
  explicit ReferenceBody(RunData<Dim>& run);

  void start() override;
  [[nodiscard]] Outcome advance(const Kick& kick) override;
  [[nodiscard]] bool changes_rows() const override;
  void show() override;
  [[nodiscard]] bool pushes() const override { return rows_.has_half_way(); }
  void push() override;
  void save(Writer& archive) const override;
  void load(Reader& archive) override;
  [[nodiscard]] bool is_loose(std::size_t i) const override { return rows_.is_loose(i); }

 protected:
  [[nodiscard]] const Fields<Dim>& bond_positions() const override { return this->run_.particles.start; }
  [[nodiscard]] Tensor<double, Dim> strain_increment(std::size_t i, const State<double, Dim>& begin) const override;
  void turn(std::size_t, State<double, Dim>&) const override {}
  void set_flux(std::size_t i, const Symmetric& stress) override;
  bool forget_crack(std::size_t i, const State<double, Dim>& state) override;
  bool shorten_band(std::size_t i) override { return bands_ && bands_->shorten(i); }
  [[nodiscard]] bool moves_on(std::size_t i) const override;

 private:
  /// Fills the lists and bonds of the base.
  BondRows<Dim> make_rows();
  void straighten(std::size_t i);
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    Self::transfer_lists(archive, self);
    BondRows<Dim>::transfer(archive, self.rows_);
    CrackRows<Dim>::transfer(archive, self.crack_rows_);
    if (self.bands_) CrackBands<Dim>::transfer(archive, *self.bands_);
  }

  BondRows<Dim> rows_;
  CrackRows<Dim> crack_rows_;
  std::optional<CrackBands<Dim>> bands_;  ///< none: H is a number or the size
};

}  // namespace fpz::sph::detail
