// Values to bytes and back: what snapshots and checkpoints are made of. Layout: a number that tells what the bytes are,
// the content, FNV-1a of all before; native byte order. A struct takes part by a function `transfer(archive, value)`
// beside it, which calls archive(member) for each member, one function for both directions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace fpz::sph {

/// The bytes are not what was written: too short, too long, damaged.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Bytes = std::span<const unsigned char>;

/// FNV-1a, 64 bits: no protection against intent, enough against damage.
[[nodiscard]] inline std::uint64_t fnv1a(Bytes bytes) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const unsigned char b : bytes) h = (h ^ b) * 1099511628211ULL;
  return h;
}

/// Bytes of a file that was read as text.
[[nodiscard]] inline Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

template <class T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// A vector or string: its length comes before its elements.
template <class C>
concept Resizable = requires(C c) {
  c.resize(std::size_t{});
  c.begin();
};

/// Appends what it is called with.
class Writer {
 public:
  Writer() = default;
  /// `magic` tells what the bytes are, and in which version.
  explicit Writer(std::uint64_t magic) { (*this)(magic); }

  template <Scalar T>
  void operator()(const T& x) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof x);
    std::memcpy(bytes_.data() + at, &x, sizeof x);
  }
  template <Resizable C>
  void operator()(const C& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const auto& x : values) (*this)(x);
  }
  template <class T, std::size_t N>
  void operator()(const std::array<T, N>& values) {
    for (const T& x : values) (*this)(x);
  }
  template <class T, int R, int C, int O>
  void operator()(const Eigen::Matrix<T, R, C, O>& m) {
    for (Eigen::Index k = 0; k < m.size(); ++k) (*this)(m.data()[k]);
  }
  template <class T>
  requires requires(Writer& w, const T& x) { transfer(w, x); }
  void operator()(const T& x) { transfer(*this, x); }

  [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }
  /// All bytes, followed by their fnv1a().
  [[nodiscard]] std::vector<unsigned char> sealed() && {
    (*this)(fnv1a(bytes_));
    return std::move(bytes_);
  }

 private:
  std::vector<unsigned char> bytes_;
};

/// Reads in the order of writing. Throws ArchiveError instead of reading beyond the end.
class Reader {
 public:
  /// Of what Writer::sealed() made, with the same `magic`; throws when it is something else or damaged.
  Reader(Bytes sealed, std::uint64_t magic) : left_(sealed) {
    std::uint64_t number = 0;
    (*this)(number);
    if (number != magic) throw ArchiveError("it is of another kind or version");
    std::uint64_t sum = 0;
    if (left_.size() < sizeof sum) throw ArchiveError("it is too short");
    left_ = left_.first(left_.size() - sizeof sum);
    std::memcpy(&sum, left_.data() + left_.size(), sizeof sum);
    if (sum != fnv1a(sealed.first(sealed.size() - sizeof sum))) throw ArchiveError("its checksum is wrong");
  }

  template <Scalar T>
  void operator()(T& x) {
    if (left_.size() < sizeof x) throw ArchiveError("it is too short");
    std::memcpy(&x, left_.data(), sizeof x);
    left_ = left_.subspan(sizeof x);
  }
  template <Resizable C>
  void operator()(C& values) {
    std::uint64_t size = 0;
    (*this)(size);
    if (size > left_.size()) throw ArchiveError("a length in it is wrong");
    values.resize(static_cast<std::size_t>(size));
    for (auto& x : values) (*this)(x);
  }
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& values) {
    for (T& x : values) (*this)(x);
  }
  template <class T, int R, int C, int O>
  void operator()(Eigen::Matrix<T, R, C, O>& m) {
    for (Eigen::Index k = 0; k < m.size(); ++k) (*this)(m.data()[k]);
  }
  template <class T>
  requires requires(Reader& r, T& x) { transfer(r, x); }
  void operator()(T& x) { transfer(*this, x); }

  /// Bytes that nothing has read.
  [[nodiscard]] std::size_t left() const { return left_.size(); }

 private:
  Bytes left_;
};

}  // namespace fpz::sph
