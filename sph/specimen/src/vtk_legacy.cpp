#include "vtk_legacy.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "fpz/io/input_error.hpp"
#include "vtk_words.hpp"

namespace fpz::specimen::detail {
namespace {

using io::InputError;

template <class T>
double big_endian(const char* bytes) {
  std::array<char, sizeof(T)> turned{};
  for (std::size_t k = 0; k < sizeof(T); ++k) turned[k] = bytes[sizeof(T) - 1 - k];
  T x;
  std::memcpy(&x, turned.data(), sizeof(T));
  return static_cast<double>(x);
}

struct NumberType {
  std::string_view word;
  std::size_t size;
  double (*value)(const char* bytes);
};
constexpr std::array<NumberType, 13> number_types = {{{"double", 8, big_endian<double>},
                                                      {"float", 4, big_endian<float>},
                                                      {"int", 4, big_endian<std::int32_t>},
                                                      {"unsigned_int", 4, big_endian<std::uint32_t>},
                                                      {"long", 8, big_endian<std::int64_t>},
                                                      {"unsigned_long", 8, big_endian<std::uint64_t>},
                                                      {"vtktypeint64", 8, big_endian<std::int64_t>},
                                                      {"vtkIdType", 8, big_endian<std::int64_t>},
                                                      {"short", 2, big_endian<std::int16_t>},
                                                      {"unsigned_short", 2, big_endian<std::uint16_t>},
                                                      {"char", 1, big_endian<signed char>},
                                                      {"unsigned_char", 1, big_endian<unsigned char>},
                                                      {"vtktypeuint64", 8, big_endian<std::uint64_t>}}};

class LegacyReader {
 public:
  LegacyReader(std::string_view text, std::string file) : words_(text), file_(std::move(file)) {}

  PointCloud read() {
    (void)words_.line(), (void)words_.line();  // version and title
    const std::string_view format = words_.next();
    if (format != "ASCII" && format != "BINARY") fail("is neither ASCII nor BINARY");
    binary_ = format == "BINARY";
    for (std::string_view w = words_.next(); !w.empty(); w = words_.next()) section(w);
    if (cloud_.points.empty()) fail("no points");
    for (const PointData& d : cloud_.data) {
      if (d.values.size() != cloud_.size() * static_cast<std::size_t>(d.components)) {
        fail("the array \"" + d.name + "\" has a wrong length");
      }
    }
    return std::move(cloud_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw InputError(file_ + ": " + why); }

  std::size_t count() {
    const auto n = words_.number();
    if (!n || *n < 0.0 || *n > 1e9) fail("a number is missing");
    return static_cast<std::size_t>(*n);
  }

  /// Values behind the line whose last word, the type, was just read.
  std::vector<double> values(std::size_t n, std::string_view type) {
    std::vector<double> all;
    if (!binary_) {
      for (std::size_t k = 0; k < n; ++k) {
        const auto x = words_.number();
        if (!x) fail("a number is missing among the data");
        all.push_back(*x);
      }
      return all;
    }
    const auto known =
        std::find_if(number_types.begin(), number_types.end(), [&](const NumberType& t) { return t.word == type; });
    if (known == number_types.end()) fail("binary numbers of type \"" + std::string(type) + "\" are not supported");
    (void)words_.line();
    const std::string_view bytes = words_.bytes(n * known->size);
    if (bytes.size() != n * known->size) fail("the file ends within its data");
    for (std::size_t k = 0; k < n; ++k) all.push_back(known->value(bytes.data() + k * known->size));
    return all;
  }

  void section(std::string_view w) {
    if (w == "POINTS") {
      const std::size_t n = count();
      cloud_.points = values(3 * n, words_.next());
    } else if (w == "POINT_DATA" || w == "CELL_DATA") {
      at_points_ = w == "POINT_DATA";
      tuples_ = count();
    } else if (w == "SCALARS" || w == "VECTORS") {
      attribute(w == "VECTORS");
    } else if (w == "FIELD") {
      (void)words_.next();
      for (std::size_t k = count(); k > 0; --k) field();
    } else if (w == "METADATA") {
      skip_metadata();
    } else if (w == "OFFSETS" || w == "CONNECTIVITY") {
      (void)values(w == "OFFSETS" ? offsets_ : connections_, words_.next());
    } else if (w == "CELLS" || w == "VERTICES" || w == "LINES" || w == "POLYGONS") {
      cells();
    } else if (w == "CELL_TYPES") {
      const std::size_t n = count();
      (void)values(n, "int");
    }
  }

  /// Since version 5 offsets and connections follow as arrays of their own; before, one array of numbers.
  void cells() {
    offsets_ = count(), connections_ = count();
    Words ahead = words_;
    if (ahead.next() == "OFFSETS") return;
    (void)values(connections_, "int");
  }

  void attribute(bool vector) {
    PointData d;
    d.name = words_.next();
    const std::string type(words_.next());
    d.components = vector ? 3 : 1;
    if (!vector) {
      Words rest(words_.line());
      if (const auto n = rest.number()) d.components = static_cast<int>(*n);
      (void)words_.next(), (void)words_.next();  // LOOKUP_TABLE name
    }
    d.values = values(tuples_ * static_cast<std::size_t>(d.components), type);
    if (at_points_) cloud_.data.push_back(std::move(d));
  }

  void field() {
    PointData d;
    d.name = words_.next();
    while (d.name == "METADATA") skip_metadata(), d.name = words_.next();
    d.components = static_cast<int>(count());
    const std::size_t n = count();
    d.values = values(n * static_cast<std::size_t>(d.components), words_.next());
    if (at_points_) cloud_.data.push_back(std::move(d));
  }

  /// Up to the next empty line.
  void skip_metadata() {
    (void)words_.line();
    while (words_.line().find_first_not_of(" \t\r") != std::string_view::npos) {
    }
  }

  Words words_;
  std::string file_;
  bool binary_ = false, at_points_ = false;
  std::size_t tuples_ = 0, offsets_ = 0, connections_ = 0;
  PointCloud cloud_;
};

}  // namespace

PointCloud read_legacy(std::string_view text, const std::string& file) { return LegacyReader(text, file).read(); }

}  // namespace fpz::specimen::detail
