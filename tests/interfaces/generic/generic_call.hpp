// A call of the generic behaviour as a client makes it, for the tests: the library is opened at run time, and the
// structures are written down here once more, from the convention. What must not be read or written is an address that
// nothing can be read from or written to.
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "fpz/point/properties.hpp"
#include "fpz/tangent.hpp"

namespace fpz::test {

struct ClientBegin {
  const double *gradients, *forces, *mass_density, *material_properties, *internal, *stored, *dissipated, *external;
};

struct ClientEnd {
  const double* gradients;
  double* forces;
  const double *mass_density, *material_properties;
  double *internal, *stored, *dissipated;
  const double* external;
};

struct ClientData {
  char* error_message;
  double dt;
  double *k, *rdt, *speed_of_sound;
  ClientBegin s0;
  ClientEnd s1;
};

/// The address of a symbol of the library, null if there is none.
inline void* find_symbol(const std::string& name) {
  static void* const library = ::dlopen(FPZ_GENERIC_LIBRARY, RTLD_NOW);
  EXPECT_NE(library, nullptr) << ::dlerror();
  return library != nullptr ? ::dlsym(library, name.c_str()) : nullptr;
}

template <class T>
const T& symbol(const std::string& name) {
  const void* address = find_symbol(name);
  if (address == nullptr) throw std::runtime_error("no symbol " + name);
  return *static_cast<const T*>(address);
}

inline Setting setting_of(const std::string& hypothesis) {
  if (hypothesis == "Tridimensional") return Setting::three_d;
  return hypothesis == "PlaneStress" ? Setting::plane_stress : Setting::plane_strain;
}

/// The material properties that say this.
inline std::vector<double> material_properties_of(const Parameters& p) {
  std::vector<double> list = point::write_properties({p, {}});
  list.resize(symbol<unsigned short>("Fpz_nMaterialProperties"));
  return list;
}

/// A point of a client with its two states. What the behaviour has to write is NaN before.
struct Client {
  static constexpr double untouched = 3.75;
  static constexpr double poison = std::numeric_limits<double>::quiet_NaN();

  std::string hypothesis;
  std::size_t size;  ///< components of strain and stress
  std::vector<double> properties, g0, g1, f0, f1, i0, i1, k;
  double stored0 = 0.0, stored1 = poison, dissipated0 = 0.0, dissipated1 = poison;
  double rdt = untouched, sound = poison;
  std::string message = std::string(512, '#');

  Client(std::string name, const Parameters& p)
      : hypothesis(std::move(name)),
        size(hypothesis == "Tridimensional" ? 6 : 4),
        properties(material_properties_of(p)),
        g0(size, 0.0),
        g1(size, 0.0),
        f0(size, 0.0),
        f1(size, poison),
        i0(symbol<unsigned short>("Fpz_" + hypothesis + "_nInternalStateVariables"), 0.0),
        i1(i0.size(), poison),
        k(size * size, poison) {}

  /// Calls with K[0] = `wanted`. With the speed of sound its address is good, otherwise it is none.
  int call(double wanted) {
    using Function = int (*)(ClientData*);
    const auto f = reinterpret_cast<Function>(find_symbol("Fpz_" + hypothesis));
    k[0] = wanted;
    message[0] = '\0';
    auto* const nowhere = reinterpret_cast<double*>(std::uintptr_t{8});
    ClientData d{message.data(),
                 poison,
                 k.data(),
                 &rdt,
                 wanted > 50.0 ? &sound : nowhere,
                 {g0.data(), f0.data(), nowhere, nowhere, i0.data(), &stored0, &dissipated0, nowhere},
                 {g1.data(), f1.data(), nowhere, properties.data(), i1.data(), &stored1, &dissipated1, nowhere}};
    return f(&d);
  }

  /// The end becomes the begin.
  void update() {
    g0 = g1;
    f0 = f1;
    i0 = i1;
    stored0 = stored1;
    dissipated0 = dissipated1;
    std::fill(f1.begin(), f1.end(), poison);
    std::fill(i1.begin(), i1.end(), poison);
  }

  [[nodiscard]] double operator_at(std::size_t i, std::size_t j) const { return k[i * size + j]; }
  [[nodiscard]] bool cracked() const { return i1[0] == 1.0; }  // tests of the symbols say that it is the first one
  [[nodiscard]] std::string text() const { return message.c_str(); }
};

/// Places of the model's components among a client's.
template <int Dim>
std::vector<std::size_t> client_places() {
  if constexpr (Dim == 3) return {0, 1, 2, 3, 4, 5};
  return {0, 1, 3};
}

/// Adds a model strain (tensor components) to a client's.
template <int Dim>
void add_strain(std::vector<double>& gradient, const Tensor<double, Dim>& strain) {
  const auto at = client_places<Dim>();
  for (int i = 0; i < tensor_size<Dim>; ++i)
    gradient[at[std::size_t(i)]] += strain[i] * (i < Dim ? 1.0 : std::sqrt(2.0));
}

/// A client's stress as a model stress.
template <int Dim>
Tensor<double, Dim> stress_of(const std::vector<double>& force) {
  const auto at = client_places<Dim>();
  Tensor<double, Dim> s;
  for (int i = 0; i < tensor_size<Dim>; ++i) s[i] = force[at[std::size_t(i)]] / (i < Dim ? 1.0 : std::sqrt(2.0));
  return s;
}

}  // namespace fpz::test
