// The state of a material point as a flat array of doubles: STATEV of a UMAT, internal state variables of a generic
// behaviour, a row of a numpy array. Zeros are a fresh point.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "fpz/state_fields.hpp"

namespace fpz::point {

/// Length of the array: the fields of state_fields.hpp in their order, matrices row by row (all are doubles but the
/// flag `cracked`, which is 0 or 1), then the damage D. 23 in two dimensions, 38 in three.
template <int Dim>
inline constexpr std::size_t state_size = sizeof(State<double, Dim>) / sizeof(double) + 1;

/// Names in the order of the array: "strain_xx" (tensor components), ..., "cracked", "frame_n_x", ..., "traction_s1",
/// ..., "damage". The crack's are 0 while a point is not cracked. The damage is for pictures: it is written, never
/// read. dim is 2 or 3.
[[nodiscard]] const std::vector<std::string>& state_names(int dim);

namespace detail {

/// Walks along a flat array with a distance between its numbers.
template <class Number>
struct Cursor {
  Number* at;
  std::ptrdiff_t stride;

  FPZ_INLINE Number& next() {
    Number& here = *at;
    at += stride;
    return here;
  }
};

/// Calls f(number) for each number of a field, in the order of the array.
template <class Field, class F>
FPZ_INLINE void each_number(Field& field, F&& f) {
  if constexpr (requires { field.rows(); }) {
    for (int i = 0; i < Field::RowsAtCompileTime; ++i) {
      for (int j = 0; j < Field::ColsAtCompileTime; ++j) f(field(i, j));
    }
  } else {
    f(field);
  }
}

/// An orthonormal frame within the accuracy that any file or transfer of states keeps.
template <int Dim>
[[nodiscard]] bool is_frame(const Mat<double, Dim, Dim>& r) {
  constexpr double rounding = 1e-5;
  for (int i = 0; i < Dim; ++i) {
    for (int j = i; j < Dim; ++j) {
      double dot = 0.0;
      for (int k = 0; k < Dim; ++k) dot += r(i, k) * r(j, k);
      if (!(std::abs(dot - (i == j ? 1.0 : 0.0)) < rounding)) return false;
    }
  }
  return true;
}

}  // namespace detail

/// What to say of an array that is not a state.
inline constexpr const char* not_a_state =
    "the state is none that this library wrote (\"cracked\" is 0 or 1, the frame is a rotation, the integrity is "
    "between "
    "0 and 1): averaged, transferred between meshes, or of another layout";

/// Reads the array into `to`; nothing of the crack is read while the point is not cracked. False when the array is not
/// a state that store() wrote, as after averaging between points or with another layout: a flag that is neither 0 nor
/// 1, a frame that is none, an integrity outside 0 to 1.
template <int Dim>
[[nodiscard]] bool load(const double* from, std::ptrdiff_t stride, State<double, Dim>& to) {
  detail::Cursor<const double> cursor{from, stride};
  double flag = 0.0;
  visit_point(to, [&](const char*, auto& field) {
    if constexpr (requires { field = true; } && sizeof field == 1) {
      flag = cursor.next();
    } else {
      detail::each_number(field, [&cursor](double& x) { x = cursor.next(); });
    }
  });
  to.cracked = flag == 1.0;
  if (!to.cracked) {
    to.frame.setIdentity();
    to.crack = {};
    return flag == 0.0;
  }
  visit_crack(
      to, [&](const char*, auto& field) { detail::each_number(field, [&cursor](double& x) { x = cursor.next(); }); });
  return detail::is_frame<Dim>(to.frame) && to.crack.integrity >= 0.0 && to.crack.integrity <= 1.0;
}

/// Writes the whole array.
template <int Dim>
void store(const State<double, Dim>& from, double* to, std::ptrdiff_t stride) {
  detail::Cursor<double> cursor{to, stride};
  visit_point(from, [&](const char*, const auto& field) {
    detail::each_number(field, [&cursor](const auto& x) { cursor.next() = double(x); });
  });
  visit_crack(from, [&](const char*, const auto& field) {
    detail::each_number(field, [&](const double& x) { cursor.next() = from.cracked ? x : 0.0; });
  });
  cursor.next() = damage(from);
}

}  // namespace fpz::point
