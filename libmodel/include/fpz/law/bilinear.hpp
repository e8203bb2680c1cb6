// Bilinear softening after Petersson, much used for concrete: two straight lines, w from 1 to 1/3 over 0.8 delta0 and
// on to zero at 3.6 delta0 of inelastic displacement kappa = up_n + up_s. The area under them is delta0, as for every
// law.
//
// Pieces: 0 the steep line, 1 the flat one, 2 nothing left (w = 0: the zone carries no tension and no shear any more,
// only contact). `paper` cannot follow the end of piece 1 and reports non_convergence there.
#pragma once

#include "fpz/law/dissipation.hpp"
#include "fpz/parameters.hpp"

namespace fpz {

template <class P>
struct BilinearSoftening {
  static constexpr const char* name = "bilinear";
  static constexpr const char* meaning = "Petersson: D = 2/3 at kappa = 0.8 delta0, D = 1 at 3.6 delta0";
  static constexpr double kink = 1.0 / 3.0;          ///< w where the lines meet
  static constexpr double first_fall = 5.0 / 6.0;    ///< -dw/d(kappa/delta0): (1 - 1/3)/0.8
  static constexpr double second_fall = 5.0 / 42.0;  ///< (1/3)/(3.6 - 0.8)

  P delta0{};           ///< m
  P steepness[3] = {};  ///< -dw/d(kappa) of each piece, 1/m

  [[nodiscard]] static BilinearSoftening make(const BasicParameters<P>& p) {
    return {p.delta0, {first_fall / p.delta0, second_fall / p.delta0, P(0.0)}};
  }
  [[nodiscard]] BilinearSoftening<double> values() const {
    return {value(delta0), {value(steepness[0]), value(steepness[1]), 0.0}};
  }

  [[nodiscard]] static int piece(double w) { return w > kink ? 0 : w > 0.0 ? 1 : 2; }
  [[nodiscard]] static P piece_end(int k) { return P(k == 0 ? kink : k == 1 ? 0.0 : -1.0); }

  template <class T>
  [[nodiscard]] T after(int k, const T& w, const T& kappa) const {
    return w - steepness[k] * kappa;
  }
  template <class T>
  [[nodiscard]] T after(const T& w, const T& kappa) const {
    T left = kappa;
    T now = w;
    for (int k = piece(value(w)); k < 2; ++k) {
      const T room = (now - piece_end(k)) / steepness[k];
      if (value(left) < value(room)) return after(k, now, left);
      left -= room;
      now = T(piece_end(k));
    }
    return now;
  }
  template <class T>
  [[nodiscard]] T slope(int k, const T&) const {
    return T(-steepness[k]);
  }
  template <class T>
  [[nodiscard]] T curvature(int, const T&) const {
    return T(0.0);
  }
  template <class T>
  [[nodiscard]] T local_length(int k, const T& w) const {
    return w / steepness[k];
  }
  [[nodiscard]] double loss(int k, double, double kappa) const { return value(steepness[k]) * kappa; }

  // The measure is D itself: a straight line dissipates plastic work in proportion to w, damage energy evenly.
  [[nodiscard]] P measure() const { return P(1.0); }
  template <class T>
  [[nodiscard]] T measure_rate(int k, const T&) const {
    return T(steepness[k]);
  }
  template <class T>
  [[nodiscard]] T density(int k, const T& w, const Dissipation<T>& d) const {
    return k < 2 ? T(d.plastic * local_length(k, w) + d.damage) : d.damage;
  }
  template <class T>
  [[nodiscard]] T dissipated(const Dissipation<double>& d0, const Dissipation<T>& d1, const T& w0, const T& w1) const {
    return 0.5 * (d0.plastic + d1.plastic) * area_between(w0, w1) + 0.5 * (d0.damage + d1.damage) * (w0 - w1);
  }

  template <class T>
  [[nodiscard]] T fall(const T& w0, const T& w1) const {
    T sum = T(0.0);
    T from = w0;
    for (int k = piece(value(w0)); k < 2 && value(from) > value(w1); ++k) {
      const T to = value(w1) > value(piece_end(k)) ? w1 : T(piece_end(k));
      sum += (from - to) / steepness[k];
      from = to;
    }
    return sum;
  }
  template <class T>
  [[nodiscard]] SofteningMoments<T> moments(int, const T& w0, const T& w1, const T& kappa) const {
    return {T(0.5 * (w0 + w1) * kappa), T((w0 * w0 + w0 * w1 + w1 * w1) * kappa / 3.0)};
  }

  [[nodiscard]] P length() const { return delta0; }
  [[nodiscard]] P shortest_length() const { return delta0 / first_fall; }
  [[nodiscard]] P area() const { return delta0; }
  template <class T>
  [[nodiscard]] T area_to(const T& kappa) const {
    return area_between(T(1.0), after(T(1.0), kappa));
  }

 private:
  /// Integral of w d(kappa) while w falls from w0 to w1, m.
  template <class T>
  [[nodiscard]] T area_between(const T& w0, const T& w1) const {
    T sum = T(0.0);
    T from = w0;
    for (int k = piece(value(w0)); k < 2; ++k) {
      const T to = value(w1) > value(piece_end(k)) ? w1 : T(piece_end(k));
      sum += 0.5 * (from - to) * (from + to) / steepness[k];
      if (value(w1) > value(piece_end(k))) break;
      from = to;
    }
    return sum;
  }
};

}  // namespace fpz
