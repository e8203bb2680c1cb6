// Softening: how the inelastic displacement kappa = up_n + up_s (m) turns into damage D = 1 - w. The library works with
// the integrity w, which stays exact when D is within rounding of one.
//
// A softening law is a plain struct of constants, templated on their scalar P, with the members of
// ExponentialSoftening, the first of them:
//   name, meaning          for files and tables
//   make(parameters)       from the material parameters; values(): the same in plain doubles
//   piece(w)               the smooth piece of w(kappa) on which w falls on; piece_end(piece): the w where that piece
//                          ends (< 0: never). The integrators stop there: a kink of w(kappa) is an event.
//   after(piece, w, kappa) w after kappa more, on the smooth continuation of the piece; after(w, kappa): through kinks
//   slope(piece, w)        dw/d(kappa), <= 0 (1/m); curvature(piece, w): d2w/d(kappa)2 (1/m^2)
//   local_length(piece, w) w/|slope| (m)
//   loss(piece, w, kappa)  |slope| kappa: what an error of kappa means for w
//   measure()              energies are summed in a measure that is linear in w, d(mu) = measure |dw|, in which the
//                          dissipation of a pure opening has little to vary; measure_rate(piece, w) = d(mu)/d(kappa);
//                          density(piece, w, dissipation): energy per d(mu). Energy per lost integrity is their
//                          product.
//   dissipated(d0, d1, w0, w1)  energy lost from w0 to w1 (J/m^2), trapezoidal in the parts of the dissipation; exact
//                          where these are constant, as in a pure opening
//   fall(w0, w1)           displacement over which w falls from w0 to w1, through kinks (m)
//   moments(piece, w0, w1, kappa)  integrals of w and w^2 over d(kappa) while w falls from w0 to w1 by `kappa` on one
//                          piece: exact sums of what is smooth in w
//   length()               a displacement over which the law softens noticeably, for step sizes and tolerances (m)
//   shortest_length()      1 over the steepest -dw/d(kappa) (m): decides on snap-back
//   area()                 integral of w d(kappa) to the end (m), area_to(kappa) the part up to kappa: mode I fracture
//                          energy is tensile strength times area
// All laws are scaled to area() = delta0, so that delta0 means the same for each: G_I / sigma_t0.
//
// The list below is the one place where a law is chosen; files name it by the key "softening".
#pragma once

#include <array>
#include <utility>
#include <variant>

#include "fpz/law/bilinear.hpp"
#include "fpz/law/exponential.hpp"
#include "fpz/law/unloading.hpp"

namespace fpz {

/// The softening laws that a material can have, the default first.
template <class P>
using SofteningLaws = std::variant<ExponentialSoftening<P>, BilinearSoftening<P>>;

/// The piece on which nothing softens any more, because the zone has come to its least integrity (unloading.hpp).
inline constexpr int settled_piece = 1000;

/// The law of a material, chosen at run time: it passes every question on to the one that it holds, down to `floor`.
template <class P>
struct Softening {
  SofteningLaws<P> law;
  double floor = 0.0;  ///< least integrity; 0: none

  [[nodiscard]] static Softening make(const BasicParameters<P>& p) { return make_from(p); }
  [[nodiscard]] Softening<double> values() const {
    return visit([this](const auto& s) { return Softening<double>{s.values(), floor}; });
  }

  /// f(law) for the law that is held; all alternatives must give one type.
  template <std::size_t I = 0, class F>
  [[nodiscard]] FPZ_INLINE auto visit(F&& f) const {
    if constexpr (I + 1 == std::variant_size_v<SofteningLaws<P>>) {
      return f(*std::get_if<I>(&law));
    } else {
      if (const auto* held = std::get_if<I>(&law)) return f(*held);
      return visit<I + 1>(std::forward<F>(f));
    }
  }

  [[nodiscard]] int piece(double w) const {
    if (w <= floor && floor > 0.0) return settled_piece;
    return visit([&](const auto& s) { return s.piece(w); });
  }
  [[nodiscard]] P piece_end(int k) const {
    if (k == settled_piece) return P(-1.0);
    const P end = visit([&](const auto& s) { return s.piece_end(k); });
    return value(end) < floor && floor > 0.0 ? P(floor) : end;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T after(int k, const T& w, const T& kappa) const {
    if (k == settled_piece) return w;
    return visit([&](const auto& s) { return s.after(k, w, kappa); });
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T after(const T& w, const T& kappa) const {
    const T left = visit([&](const auto& s) { return s.after(w, kappa); });
    return value(left) < floor ? T(floor) : left;
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T slope(int k, const T& w) const {
    if (k == settled_piece) return T(0.0);
    return visit([&](const auto& s) { return s.slope(k, w); });
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T curvature(int k, const T& w) const {
    if (k == settled_piece) return T(0.0);
    return visit([&](const auto& s) { return s.curvature(k, w); });
  }
  template <class T>
  [[nodiscard]] T local_length(int k, const T& w) const {
    if (k == settled_piece) return T(unbounded);
    return visit([&](const auto& s) { return s.local_length(k, w); });
  }
  [[nodiscard]] double loss(int k, double w, double kappa) const {
    if (k == settled_piece) return 0.0;
    return visit([&](const auto& s) { return s.loss(k, w, kappa); });
  }
  [[nodiscard]] P measure() const {
    return visit([](const auto& s) { return s.measure(); });
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T measure_rate(int k, const T& w) const {
    return visit([&](const auto& s) { return s.measure_rate(k, w); });
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T density(int k, const T& w, const Dissipation<T>& d) const {
    return visit([&](const auto& s) { return s.density(k, w, d); });
  }
  template <class T>
  [[nodiscard]] FPZ_INLINE T dissipated(const Dissipation<double>& d0, const Dissipation<T>& d1, const T& w0,
                                        const T& w1) const {
    return visit([&](const auto& s) { return s.dissipated(d0, d1, w0, w1); });
  }
  template <class T>
  [[nodiscard]] T fall(const T& w0, const T& w1) const {
    return visit([&](const auto& s) { return s.fall(w0, w1); });
  }
  template <class T>
  [[nodiscard]] SofteningMoments<T> moments(int k, const T& w0, const T& w1, const T& kappa) const {
    if (k == settled_piece) return {T(w0 * kappa), T(w0 * w0 * kappa)};
    return visit([&](const auto& s) { return s.moments(k, w0, w1, kappa); });
  }
  [[nodiscard]] P length() const {
    return visit([](const auto& s) { return s.length(); });
  }
  [[nodiscard]] P shortest_length() const {
    return visit([](const auto& s) { return s.shortest_length(); });
  }
  [[nodiscard]] P area() const {
    return visit([](const auto& s) { return s.area(); });
  }
  template <class T>
  [[nodiscard]] T area_to(const T& kappa) const {
    return visit([&](const auto& s) { return s.area_to(kappa); });
  }

 private:
  template <std::size_t I = 0>
  [[nodiscard]] static Softening make_from(const BasicParameters<P>& p) {
    if constexpr (I + 1 < std::variant_size_v<SofteningLaws<P>>) {
      if (p.choices.softening != static_cast<SofteningKind>(I)) return make_from<I + 1>(p);
    }
    return {std::variant_alternative_t<I, SofteningLaws<P>>::make(p), integrity_floor(p.choices.cohesive_zone)};
  }
};

namespace detail {

template <std::size_t... I>
[[nodiscard]] constexpr auto softening_words(std::index_sequence<I...>) {
  return std::array<Word<SofteningKind>, sizeof...(I)>{
      {{static_cast<SofteningKind>(I), std::variant_alternative_t<I, SofteningLaws<double>>::name}...}};
}

template <class Law, std::size_t I = 0>
[[nodiscard]] constexpr SofteningKind softening_kind() {
  if constexpr (std::is_same_v<Law, std::variant_alternative_t<I, SofteningLaws<double>>>) {
    return static_cast<SofteningKind>(I);
  } else {
    return softening_kind<Law, I + 1>();
  }
}

}  // namespace detail

/// The kind of a law, e.g. softening_kind<ExponentialSoftening>.
template <template <class> class Law>
inline constexpr SofteningKind softening_kind = detail::softening_kind<Law<double>>();

template <>
struct Words<SofteningKind> {
  static constexpr auto list =
      detail::softening_words(std::make_index_sequence<std::variant_size_v<SofteningLaws<double>>>{});
};

}  // namespace fpz
