#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>

#include "fpz/io/json_locator.hpp"
#include "fpz/specimen/vtu.hpp"
#include "vtk_legacy.hpp"
#include "vtk_words.hpp"
#include "vtu_block.hpp"

namespace fpz::specimen {
namespace {

using namespace detail;
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
    const std::string compressor = attribute(head, "compressor");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      fail("is compressed by " + compressor + "; write it with vtkZLibDataCompressor or without compression");
    }
    format_.compressed = !compressor.empty();
    if (attribute(head, "byte_order") != "LittleEndian") fail("is not little-endian");
    format_.wide = attribute(head, "header_type") == "UInt64";
    if (const auto at = text_.find("<AppendedData"); at != std::string_view::npos) {
      format_.base64 = attribute(tag("<AppendedData", 0), "encoding") == "base64";
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
      const auto begin = at + t.size() + 1;
      const std::string_view inside = text_.substr(begin, text_.find('<', begin) - begin);
      if (format == "appended") {
        d.values = convert(attribute(t, "type"), block(attribute(t, "offset")), file_);
      } else if (format == "binary") {
        d.values = convert(attribute(t, "type"), block_at(inside, {true, format_.compressed, format_.wide}), file_);
      } else if (format == "ascii") {
        Words words(inside);
        while (const auto x = words.number()) d.values.push_back(*x);
      } else {
        fail("arrays of format \"" + format + "\" are not supported (ascii, binary and appended are)");
      }
      all.push_back(std::move(d));
    }
    return all;
  }

  [[nodiscard]] std::string block(const std::string& offset) const {
    const auto at = count_of(offset);
    if (!at || *at > text_.size() - appended_) fail("an appended block lies outside the file");
    return block_at(text_.substr(appended_ + *at), format_);
  }

  [[nodiscard]] std::string block_at(std::string_view text, const BlockFormat& format) const {
    try {
      return read_block(text, format);
    } catch (const std::runtime_error& e) {
      fail(e.what());
    }
  }

  std::string_view text_;
  std::string file_;
  BlockFormat format_;
  std::size_t appended_ = std::string_view::npos;
};

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
