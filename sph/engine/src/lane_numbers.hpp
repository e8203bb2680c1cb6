// Numbers of all lanes of a block in registers as wide as the instruction set's (FPZ_SPH_WIDTH numbers). Operations are
// lane by lane, so the width changes no bit.
#pragma once

#include "fpz/sph/lanes.hpp"
#include "plane.hpp"

namespace fpz::sph::detail {
namespace FPZ_SPH_ISA {
namespace {

using Register = double __attribute__((vector_size(8 * FPZ_SPH_WIDTH)));

template <class Half>
struct Pair {
  Half low, high;
};

template <class H>
FPZ_LANE Pair<H> operator+(const Pair<H>& a, const Pair<H>& b) {
  return {a.low + b.low, a.high + b.high};
}
template <class H>
FPZ_LANE Pair<H> operator-(const Pair<H>& a, const Pair<H>& b) {
  return {a.low - b.low, a.high - b.high};
}
template <class H>
FPZ_LANE Pair<H> operator*(const Pair<H>& a, const Pair<H>& b) {
  return {a.low * b.low, a.high * b.high};
}
template <class H>
FPZ_LANE Pair<H> operator*(const Pair<H>& a, double b) {
  return {a.low * b, a.high * b};
}
template <class H>
FPZ_LANE Pair<H> operator*(double a, const Pair<H>& b) {
  return {a * b.low, a * b.high};
}
template <class H>
FPZ_LANE void operator+=(Pair<H>& a, const Pair<H>& b) {
  a = a + b;
}

template <int numbers>
struct NumbersOf {
  using Half = NumbersOf<numbers / 2>;
  using Type = Pair<typename Half::Type>;
  static constexpr int half = numbers / 2;
  FPZ_INLINED static Type load(const double* a) { return {Half::load(a), Half::load(a + half)}; }
  FPZ_INLINED static Type gather(const double* a, const int* j) {
    return {Half::gather(a, j), Half::gather(a, j + half)};
  }
  FPZ_INLINED static void store(const Type& x, double* a) {
    Half::store(x.low, a);
    Half::store(x.high, a + half);
  }
};

template <>
struct NumbersOf<FPZ_SPH_WIDTH> {
  using Type = Register;
  using InMemory = double __attribute__((vector_size(8 * FPZ_SPH_WIDTH), aligned(8), may_alias));
  FPZ_INLINED static Type load(const double* a) { return *reinterpret_cast<const InMemory*>(a); }
  FPZ_INLINED static Type gather(const double* a, const int* j) {
    Type x;
    for (int l = 0; l < FPZ_SPH_WIDTH; ++l) x[l] = a[j[l]];
    return x;
  }
  FPZ_INLINED static void store(const Type& x, double* a) { *reinterpret_cast<InMemory*>(a) = x; }
};

using Numbers = NumbersOf<static_cast<int>(lanes)>;
using Lanes = Numbers::Type;

}  // namespace
}  // namespace FPZ_SPH_ISA
}  // namespace fpz::sph::detail
