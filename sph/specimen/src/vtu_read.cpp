#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "fpz/io/json_locator.hpp"
#include "fpz/specimen/vtu.hpp"

namespace fpz::specimen {
namespace {

using io::InputError;

/// The value of an attribute of a tag; empty when it is not there.
std::string attribute(std::string_view tag, std::string_view name) {
  std::string key(1, ' ');
  key.append(name).append("=\"");
  const auto at = tag.find(key);
  if (at == std::string_view::npos) return {};
  const auto begin = at + key.size();
  const auto end = tag.find('"', begin);
  return end == std::string_view::npos ? std::string() : std::string(tag.substr(begin, end - begin));
}

std::optional<std::size_t> count_of(const std::string& text) {
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return n;
}

/// Words of a text, one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}
  std::string_view next() {
    const auto begin = text_.find_first_not_of(blanks, at_);
    if (begin == std::string_view::npos) return at_ = text_.size(), std::string_view();
    const auto end = std::min(text_.find_first_of(blanks, begin), text_.size());
    at_ = end;
    return text_.substr(begin, end - begin);
  }
  std::optional<double> number() {
    const std::string_view w = next();
    double x = 0.0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x);
    if (w.empty() || error != std::errc() || end != w.data() + w.size()) return std::nullopt;
    return x;
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }

 private:
  static constexpr const char* blanks = " \t\r\n";
  std::string_view text_;
  std::size_t at_ = 0;
};

template <class T>
std::vector<double> convert(std::string_view raw) {
  std::vector<double> values(raw.size() / sizeof(T));
  for (std::size_t k = 0; k < values.size(); ++k) {
    T x;
    std::memcpy(&x, raw.data() + k * sizeof(T), sizeof(T));
    values[k] = static_cast<double>(x);
  }
  return values;
}

std::vector<double> convert(const std::string& type, std::string_view raw, const std::string& file) {
  if (type == "Float64") return convert<double>(raw);
  if (type == "Float32") return convert<float>(raw);
  if (type == "Int64") return convert<std::int64_t>(raw);
  if (type == "Int32") return convert<std::int32_t>(raw);
  if (type == "UInt8") return convert<std::uint8_t>(raw);
  throw InputError(file + ": arrays of type \"" + type + "\" are not supported");
}

class VtuReader {
 public:
  VtuReader(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  PointCloud read() {
    const std::string_view head = tag("<VTKFile", 0);
    if (attribute(head, "type") != "UnstructuredGrid") fail("not a VTK unstructured grid");
    if (!attribute(head, "compressor").empty()) fail("is compressed; write it without compression");
    if (attribute(head, "byte_order") != "LittleEndian") fail("is not little-endian");
    wide_ = attribute(head, "header_type") == "UInt64";
    if (const auto at = text_.find("<AppendedData"); at != std::string_view::npos) {
      if (attribute(tag("<AppendedData", 0), "encoding") != "raw") fail("appended data must be raw");
      appended_ = text_.find('_', at) + 1;
    }
    const auto points = count_of(attribute(tag("<Piece", 0), "NumberOfPoints"));
    if (!points) fail("no number of points");
    PointCloud cloud;
    if (text_.substr(0, appended_).find("\"TimeValue\"") != std::string_view::npos) {
      for (PointData& d : arrays("<FieldData", "</FieldData>")) {
        if (d.name == "TimeValue" && !d.values.empty()) cloud.time = d.values[0];
      }
    }
    auto positions = arrays("<Points", "</Points>");
    if (positions.size() != 1 || positions[0].components != 3) fail("no array of points with three components");
    cloud.points = std::move(positions[0].values);
    cloud.data = arrays("<PointData", "</PointData>");
    if (cloud.points.size() != 3 * *points) fail("the array of points is not as long as declared");
    for (const PointData& d : cloud.data) {
      if (d.values.size() != *points * static_cast<std::size_t>(d.components))
        fail("the array \"" + d.name + "\" has a wrong length");
    }
    return cloud;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw InputError(file_ + ": " + why); }

  [[nodiscard]] std::string_view tag(std::string_view name, std::size_t from) const {
    const auto begin = text_.find(name, from);
    const auto end = text_.find('>', begin);
    if (begin == std::string_view::npos || end == std::string_view::npos) fail("no element " + std::string(name) + ">");
    return text_.substr(begin, end - begin);
  }

  [[nodiscard]] std::vector<PointData> arrays(std::string_view open, std::string_view close) const {
    std::vector<PointData> all;
    const auto end = text_.find(close);
    auto at = text_.find(open);
    if (at == std::string_view::npos || end == std::string_view::npos) return all;
    for (at = text_.find("<DataArray", at); at < end; at = text_.find("<DataArray", at + 1)) {
      const std::string_view t = tag("<DataArray", at);
      PointData d;
      d.name = attribute(t, "Name");
      const std::string components = attribute(t, "NumberOfComponents");
      const auto n = components.empty() ? std::optional<std::size_t>(1) : count_of(components);
      if (!n || *n == 0 || *n > 100) fail("an array with a wrong number of components");
      d.components = static_cast<int>(*n);
      const std::string format = attribute(t, "format");
      if (format == "appended") {
        d.values = convert(attribute(t, "type"), block(attribute(t, "offset")), file_);
      } else if (format == "ascii") {
        const auto begin = at + t.size() + 1;
        Words words(text_.substr(begin, text_.find('<', begin) - begin));
        while (const auto x = words.number()) d.values.push_back(*x);
      } else {
        fail("arrays of format \"" + format + "\" are not supported (ascii and raw appended are)");
      }
      all.push_back(std::move(d));
    }
    return all;
  }

  [[nodiscard]] std::string_view block(const std::string& offset) const {
    const auto at = count_of(offset);
    const std::size_t width = wide_ ? 8 : 4;
    const std::size_t begin = appended_ + at.value_or(text_.size());
    if (!at || begin + width > text_.size()) fail("an appended block lies outside the file");
    std::uint64_t length = 0;
    std::memcpy(&length, text_.data() + begin, width);
    if (length > text_.size() - begin - width) fail("the file ends within its data");
    return text_.substr(begin + width, length);
  }

  std::string_view text_;
  std::string file_;
  bool wide_ = false;
  std::size_t appended_ = std::string_view::npos;
};

PointCloud read_legacy(std::string_view text, const std::string& file) {
  const auto fail = [&](const std::string& why) { throw InputError(file + ": " + why); };
  const auto header_end = text.find('\n', text.find('\n') + 1);  // version and title
  Words words(text.substr(std::min(header_end, text.size())));
  if (words.next() != "ASCII") fail("only ASCII legacy files are supported; write it as .vtu or as ASCII");
  PointCloud cloud;
  std::size_t tuples = 0;
  const auto count = [&] {
    const auto n = words.number();
    if (!n || *n < 0.0 || *n > 1e9) fail("a number is missing");
    return static_cast<std::size_t>(*n);
  };
  const auto values = [&](std::size_t n) {
    std::vector<double> v;
    for (std::size_t k = 0; k < n; ++k) {
      const auto x = words.number();
      if (!x) fail("a number is missing among the data");
      v.push_back(*x);
    }
    return v;
  };
  bool at_points = false;
  for (std::string_view w = words.next(); !w.empty(); w = words.next()) {
    if (w == "POINTS") {
      const std::size_t n = count();
      (void)words.next();
      cloud.points = values(3 * n);
    } else if (w == "POINT_DATA") {
      tuples = count();
      at_points = true;
    } else if (w == "CELL_DATA") {
      at_points = false;
      tuples = count();
    } else if (w == "SCALARS" || w == "VECTORS") {
      PointData d;
      d.name = words.next();
      d.components = w == "VECTORS" ? 3 : 1;
      words.skip_line();
      if (w == "SCALARS") (void)words.next(), (void)words.next();  // LOOKUP_TABLE name
      d.values = values(tuples * static_cast<std::size_t>(d.components));
      if (at_points) cloud.data.push_back(std::move(d));
    } else if (w == "FIELD") {
      (void)words.next();
      for (std::size_t k = count(); k > 0; --k) {
        PointData d;
        d.name = words.next();
        d.components = static_cast<int>(count());
        const std::size_t n = count();
        (void)words.next();
        d.values = values(n * static_cast<std::size_t>(d.components));
        if (at_points) cloud.data.push_back(std::move(d));
      }
    }
  }
  if (cloud.points.empty()) fail("no points");
  for (const PointData& d : cloud.data) {
    if (d.values.size() != cloud.size() * static_cast<std::size_t>(d.components))
      fail("the array \"" + d.name + "\" has a wrong length");
  }
  return cloud;
}

std::string text_of(const std::filesystem::path& file) {
  io::ReadLimits limits;
  limits.bytes = std::size_t{4} << 30;
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, limits, text, error)) {
    throw InputError(file.string() + ": cannot be read: " + error);
  }
  return text;
}

}  // namespace

PointCloud read_vtk(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  if (text.starts_with("# vtk")) return read_legacy(text, file.string());
  return VtuReader(text, file.string()).read();
}

std::vector<Frame> read_pvd(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  std::vector<Frame> frames;
  for (auto at = text.find("<DataSet"); at != std::string::npos; at = text.find("<DataSet", at + 1)) {
    const std::string_view tag = std::string_view(text).substr(at, text.find('>', at) - at);
    const std::string time = attribute(tag, "timestep");
    frames.push_back({Words(time).number().value_or(0.0), attribute(tag, "file")});
  }
  return frames;
}

}  // namespace fpz::specimen
