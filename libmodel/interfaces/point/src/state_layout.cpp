#include "fpz/point/state_layout.hpp"

#include <stdexcept>

namespace fpz::point {

namespace {

constexpr const char* axes[] = {"n", "s1", "s2"};
constexpr const char* directions[] = {"x", "y", "z"};

std::string tensor_component(int dim, int k) {
  constexpr const char* of_two[] = {"xx", "yy", "xy"};
  constexpr const char* of_three[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
  return dim == 2 ? of_two[k] : of_three[k];
}

template <int Dim>
std::vector<std::string> names() {
  std::vector<std::string> list;
  const State<double, Dim> s;
  const auto add = [&list](const std::string& name, const auto& field) {
    if constexpr (!requires { field.rows(); }) {
      list.push_back(name);
    } else if constexpr (std::decay_t<decltype(field)>::ColsAtCompileTime > 1) {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) list.push_back(name + "_" + axes[i] + "_" + directions[j]);
      }
    } else if constexpr (std::decay_t<decltype(field)>::RowsAtCompileTime == tensor_size<Dim>) {
      for (int k = 0; k < tensor_size<Dim>; ++k) list.push_back(name + "_" + tensor_component(Dim, k));
    } else {
      for (int k = 0; k < Dim; ++k) list.push_back(name + "_" + axes[k]);
    }
  };
  visit_point(s, add);
  visit_crack(s, add);
  list.push_back("damage");
  return list;
}

}  // namespace

const std::vector<std::string>& state_names(int dim) {
  static const std::vector<std::string> of_two = names<2>();
  static const std::vector<std::string> of_three = names<3>();
  if (dim != 2 && dim != 3) throw std::invalid_argument("state_names: the dimension is 2 or 3");
  return dim == 2 ? of_two : of_three;
}

}  // namespace fpz::point
