// Between numpy arrays and the library's tensors and states.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <string>
#include <type_traits>

#include "fpz/plane_frame.hpp"
#include "fpz/point/state_layout.hpp"
#include "fpz/state_fields.hpp"

namespace fpz::python {

namespace py = pybind11;

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// "(3,)", as numpy shows a shape.
[[nodiscard]] std::string shape_text(const py::array& a);

/// Reads N numbers from anything that numpy makes an array of; `what` names it in the message.
template <int N>
[[nodiscard]] Vec<double, N> read_vector(const py::handle& object, const char* what) {
  const DoubleArray a = DoubleArray::ensure(object);
  if (!a) {
    PyErr_Clear();
    throw py::type_error(std::string(what) + " must be an array of " + std::to_string(N) + " numbers");
  }
  if (a.ndim() != 1 || a.shape(0) != N) {
    throw py::value_error(std::string(what) + " has the shape " + shape_text(a) + "; it must be (" + std::to_string(N) +
                          ",): " +
                          (N == 2   ? "x, y"
                           : N == 6 ? "xx, yy, zz, xy, xz, yz"
                                    : "three components"));
  }
  Vec<double, N> v;
  for (int k = 0; k < N; ++k) v[k] = a.at(k);
  return v;
}

template <int N>
[[nodiscard]] py::array_t<double> to_array(const Vec<double, N>& v) {
  return py::array_t<double>(N, v.data());
}

/// Rows as rows, whatever the storage order.
template <int N>
[[nodiscard]] py::array_t<double> to_array(const Mat<double, N, N>& m) {
  py::array_t<double> a({N, N});
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) a.mutable_at(i, j) = m(i, j);
  }
  return a;
}

/// The record of a State in memory: fields of state_fields.hpp under their names. Matrices are stored column by column,
/// so that field "frame" has the axes n, s1[, s2] as its columns.
template <int Dim>
[[nodiscard]] py::dtype state_dtype() {
  static_assert(std::is_standard_layout_v<State<double, Dim>>);
  py::list names, formats, offsets;
  const State<double, Dim> s;
  const auto add = [&](const char* name, const auto& field) {
    using Field = std::remove_cvref_t<decltype(field)>;
    names.append(name);
    offsets.append(reinterpret_cast<const char*>(&field) - reinterpret_cast<const char*>(&s));
    if constexpr (std::is_same_v<Field, bool>) {
      formats.append("?");
    } else if constexpr (std::is_same_v<Field, double>) {
      formats.append("f8");
    } else if constexpr (Field::ColsAtCompileTime == 1) {
      formats.append(py::make_tuple("f8", py::make_tuple(int{Field::RowsAtCompileTime})));
    } else {
      static_assert(!Field::IsRowMajor);
      formats.append(
          py::make_tuple("f8", py::make_tuple(int{Field::ColsAtCompileTime}, int{Field::RowsAtCompileTime})));
    }
  };
  visit_point(s, add);
  visit_crack(s, add);
  return py::dtype(names, formats, offsets, sizeof s);
}

inline constexpr const char* not_a_state =
    "is not a state that fpz made: `cracked` is neither true nor false, the frame of a crack is not orthonormal, or "
    "its "
    "integrity is not between 0 and 1";

/// Whether the bytes of a record are a state; whatever memory they come from.
template <int Dim>
[[nodiscard]] bool is_state(const void* record) {
  const State<double, Dim>& s = *static_cast<const State<double, Dim>*>(record);
  unsigned char flag = 0;
  std::memcpy(&flag, &s.cracked, 1);
  if (flag != 1) return flag == 0;
  return point::detail::is_frame<Dim>(s.frame) && s.crack.integrity >= 0.0 && s.crack.integrity <= 1.0;
}

}  // namespace fpz::python
