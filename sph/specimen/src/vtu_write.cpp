#include <bit>
#include <cstdint>
#include <cstring>

#include "fpz/io/output.hpp"
#include "fpz/io/problems.hpp"
#include "fpz/specimen/vtu.hpp"

namespace fpz::specimen {
namespace {

static_assert(std::endian::native == std::endian::little, "files are declared little-endian");

/// The data blocks behind the XML: each begins with its length in bytes.
class Appended {
 public:
  template <class T, class U>
  std::size_t add(const std::vector<U>& values) {
    const std::size_t offset = bytes.size();
    const std::uint64_t length = values.size() * sizeof(T);
    append(length);
    for (const U& v : values) append(static_cast<T>(v));
    return offset;
  }
  std::string bytes;

 private:
  template <class T>
  void append(T x) {
    char raw[sizeof(T)];
    std::memcpy(raw, &x, sizeof(T));
    bytes.append(raw, sizeof(T));
  }
};

std::string array(const std::string& type, const std::string& name, int components, std::size_t offset) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\" format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
}

}  // namespace

const PointData* PointCloud::find(const std::string& name) const {
  for (const PointData& d : data) {
    if (d.name == name) return &d;
  }
  return nullptr;
}

void write_vtu(const std::filesystem::path& file, const PointCloud& cloud) {
  Appended appended;
  const std::size_t n = cloud.size();
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">" +
      io::exact(cloud.time) + "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(n) +
      "\" NumberOfCells=\"" + std::to_string(n) + "\">\n<PointData>\n";
  for (const PointData& d : cloud.data) {
    xml += d.single ? array("Float32", d.name, d.components, appended.add<float>(d.values))
                    : array("Float64", d.name, d.components, appended.add<double>(d.values));
  }
  xml += "</PointData>\n<CellData/>\n<Points>\n";
  xml += array("Float64", "Points", 3, appended.add<double>(cloud.points)) + "</Points>\n<Cells>\n";
  std::vector<std::int64_t> index(n), offset(n);
  for (std::size_t i = 0; i < n; ++i) {
    index[i] = static_cast<std::int64_t>(i);
    offset[i] = index[i] + 1;
  }
  constexpr std::uint8_t vertex = 1;
  xml += array("Int64", "connectivity", 1, appended.add<std::int64_t>(index));
  xml += array("Int64", "offsets", 1, appended.add<std::int64_t>(offset));
  xml += array("UInt8", "types", 1, appended.add<std::uint8_t>(std::vector<std::uint8_t>(n, vertex)));
  xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  io::write_text(file, xml + appended.bytes + "\n</AppendedData>\n</VTKFile>\n", true);
}

void write_pvd(const std::filesystem::path& file, const std::vector<Frame>& frames) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const Frame& f : frames) {
    xml += "<DataSet timestep=\"" + io::exact(f.time) + "\" part=\"0\" file=\"" + f.file + "\"/>\n";
  }
  io::write_text(file, xml + "</Collection>\n</VTKFile>\n", true);
}

}  // namespace fpz::specimen
