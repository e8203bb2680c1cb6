// The ways in which VTK's own writers write points: files made by hand with Python's struct, zlib and base64.
#include <gtest/gtest.h>

#include <fstream>

#include "fpz/io/input_error.hpp"
#include "fpz/specimen/specimen.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace fpz::specimen;
namespace fs = std::filesystem;

/// Bytes from base64, so that binary files can stand in the code.
std::string bytes_of(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = (bits << 6U) | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>((bits >> count) & 255U);
  }
  return bytes;
}

fs::path written(const std::string& name, const std::string& content) {
  const fs::path file = fpz::test::fresh_path(name);
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

/// Three particles: places, volumes and groups.
void expect_particles(const fs::path& file, double tolerance) {
  const fpz::sph::Arrangement<2> a = read_particles(file, 1e-3);
  ASSERT_EQ(a.size(), 3u) << file;
  EXPECT_NEAR((a.position[2] - Point(0.001, 0.002)).norm(), 0.0, tolerance);
  EXPECT_EQ(a.volume, (std::vector<double>{1e-6, 2e-6, 3e-6}));
  EXPECT_EQ(a.group, (std::vector<int>{-1, -1, 0}));
}

const std::string inline_compressed = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64" compressor="vtkZLibDataCompressor">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="0">
<PointData><DataArray type="Float64" Name="volume" format="binary">
  AgAAAAAAAAAQAAAAAAAAAAgAAAAAAAAAFQAAAAAAAAAQAAAAAAAAAA==eJzrfbt1wfdjG+x6wfQBOwBgGgsFeJwLeSJQWKx10g4AD5MDXg==
</DataArray><DataArray type="Int32" Name="group" format="binary">AQAAAAAAAAAABAAAAAAAAAwAAAAAAAAADgAAAAAAAAA=eJz7/x8CGIAAAEPIB/k=</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="binary">AwAAAAAAAAAgAAAAAAAAAAgAAAAAAAAAFAAAAAAAAAAXAAAAAAAAAAsAAAAAAAAAeJxjYMAO/qz8eMk3KcAeABmYBKd4nGNgQAV/Vn685JsUYA+hE+wBWGAJXXicY2CAAAAACAAB</DataArray></Points></Piece></UnstructuredGrid></VTKFile>)";
const std::string appended_base64 = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32">
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="0">
<PointData><DataArray type="Float64" Name="volume" format="appended" offset="0"/><DataArray type="Int32" Name="group" format="appended" offset="40"/></PointData><Points><DataArray type="Float64" NumberOfComponents="3" format="appended" offset="64"/></Points></Piece></UnstructuredGrid>
<AppendedData encoding="base64">
_GAAAAI3ttaD3xrA+je21oPfGwD5U5BBxcyrJPg==DAAAAP//////////AAAAAA==SAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPyp8dJNYlA/AAAAAAAAAAAAAAAAAAAAAPyp8dJNYlA//Knx0k1iYD8AAAAAAAAAAA==
</AppendedData></VTKFile>)";
constexpr const char* appended_raw_compressed =
    "PD94bWwgdmVyc2lvbj0iMS4wIj8+CjxWVEtGaWxlIHR5cGU9IlVuc3RydWN0dXJlZEdyaWQiIHZlcnNpb249IjEuMCIgYnl0ZV9v"
    "cmRlcj0iTGl0dGxlRW5kaWFuIiBoZWFkZXJfdHlwZT0iVUludDMyIiBjb21wcmVzc29yPSJ2dGtaTGliRGF0YUNvbXByZXNzb3Ii"
    "Pgo8VW5zdHJ1Y3R1cmVkR3JpZD48UGllY2UgTnVtYmVyT2ZQb2ludHM9IjMiIE51bWJlck9mQ2VsbHM9IjAiPgo8UG9pbnREYXRh"
    "PjxEYXRhQXJyYXkgdHlwZT0iRmxvYXQ2NCIgTmFtZT0idm9sdW1lIiBmb3JtYXQ9ImFwcGVuZGVkIiBvZmZzZXQ9IjAiLz48RGF0"
    "YUFycmF5IHR5cGU9IkludDMyIiBOYW1lPSJncm91cCIgZm9ybWF0PSJhcHBlbmRlZCIgb2Zmc2V0PSI1NyIvPjwvUG9pbnREYXRh"
    "PjxQb2ludHM+PERhdGFBcnJheSB0eXBlPSJGbG9hdDY0IiBOdW1iZXJPZkNvbXBvbmVudHM9IjMiIGZvcm1hdD0iYXBwZW5kZWQi"
    "IG9mZnNldD0iMTAwIi8+PC9Qb2ludHM+PC9QaWVjZT48L1Vuc3RydWN0dXJlZEdyaWQ+CjxBcHBlbmRlZERhdGEgZW5jb2Rpbmc9"
    "InJhdyI+Cl8CAAAAEAAAAAgAAAAVAAAAEAAAAHic6327dcH3YxvsesH0ATsAYBoLBXicC3kiUFisddIOAA+TA14CAAAACAAAAAQA"
    "AAALAAAADAAAAHic+/8fAgAj5Af5eJxjYGBgAAAABAABAQAAAACAAABIAAAAGwAAAHicY2DADv6s/HjJNynAHpc4hE6AywMAdt8O"
    "Awo8L0FwcGVuZGVkRGF0YT48L1ZUS0ZpbGU+";
constexpr const char* legacy_binary =
    "IyB2dGsgRGF0YUZpbGUgVmVyc2lvbiA1LjEKcGFydGljbGVzCkJJTkFSWQpEQVRBU0VUIFVOU1RSVUNUVVJFRF9HUklEClBPSU5U"
    "UyAzIGZsb2F0CgAAAAAAAAAAAAAAADqDEm8AAAAAAAAAADqDEm87AxJvAAAAAApNRVRBREFUQQpJTkZPUk1BVElPTiAxCk5BTUUg"
    "TDJfTk9STV9SQU5HRSBMT0NBVElPTiB2dGtEYXRhQXJyYXkKREFUQSAyIDAgMC4wMDIyCgpDRUxMUyA0IDMKT0ZGU0VUUyB2dGt0"
    "eXBlaW50NjQKAAAAAAAAAAAAAAAAAAAAAQAAAAAAAAACAAAAAAAAAAMKQ09OTkVDVElWSVRZIHZ0a3R5cGVpbnQ2NAoAAAAAAAAA"
    "AAAAAAAAAAABAAAAAAAAAAIKQ0VMTF9UWVBFUyAzCgAAAAEAAAABAAAAAQpQT0lOVF9EQVRBIDMKRklFTEQgRmllbGREYXRhIDIK"
    "dm9sdW1lIDEgMyBkb3VibGUKPrDG96C17Y0+wMb3oLXtjT7JKnNxEORUCk1FVEFEQVRBCklORk9STUFUSU9OIDAKCmdyb3VwIDEg"
    "MyBpbnQK//////////8AAAAACk1FVEFEQVRBCklORk9STUFUSU9OIDAKCg==";

TEST(VtkFormats, InlineBase64CompressedInParts) { expect_particles(written("inline.vtu", inline_compressed), 0.0); }
TEST(VtkFormats, AppendedBase64) { expect_particles(written("base64.vtu", appended_base64), 0.0); }
TEST(VtkFormats, AppendedRawCompressed) {
  expect_particles(written("raw.vtu", bytes_of(appended_raw_compressed)), 0.0);
}
TEST(VtkFormats, LegacyBinaryWithMetadataAndFields) {
  expect_particles(written("binary.vtk", bytes_of(legacy_binary)), 1e-9);
}

TEST(VtkFormats, DamageIsFound) {
  const auto refused = [](const std::string& name, const std::string& content, const char* why) {
    try {
      (void)read_vtk(written(name, content));
      ADD_FAILURE() << name << " was read";
    } catch (const fpz::io::InputError& e) {
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  };
  std::string packed = bytes_of(appended_raw_compressed);
  packed[packed.find("\n_") + 30] ^= 0x55;
  refused("damaged.vtu", packed, "a compressed block is");
  refused("short.vtk", bytes_of(legacy_binary).substr(0, 110), "the file ends within its data");
  std::string other = inline_compressed;
  other.replace(other.find("vtkZLib"), 7, "vtkLZ4_");
  refused("lz4.vtu", other, "is compressed by vtkLZ4_DataCompressor; write it with vtkZLibDataCompressor");
  std::string wrong = inline_compressed;
  wrong[wrong.find("format=\"binary\">") + 30] = '!';
  refused("letters.vtu", wrong, "is not base64");
}

}  // namespace
