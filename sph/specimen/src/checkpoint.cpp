#include "checkpoint.hpp"

#include "fpz/io/input_error.hpp"
#include "fpz/io/json_locator.hpp"
#include "fpz/io/output.hpp"
#include "fpz/sph/archive.hpp"

namespace fpz::specimen::detail {
namespace {

constexpr std::uint64_t magic = 0x35305055524b4346ULL;  // "FCKRUP05"

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  sph::Writer writer(magic);
  writer(checkpoint);
  const std::vector<unsigned char> bytes = std::move(writer).sealed();
  io::write_text(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), true);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  io::ReadLimits limits;
  limits.bytes = std::size_t{64} << 30;
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, limits, text, error)) {
    throw io::InputError(file.string() + ": no checkpoint to resume from: " + error);
  }
  try {
    Checkpoint checkpoint;
    sph::Reader reader(sph::bytes_of(text), magic);
    reader(checkpoint);
    if (reader.left() != 0) throw sph::ArchiveError("it is too long");
    return checkpoint;
  } catch (const sph::ArchiveError& e) {
    throw io::InputError(file.string() + ": the checkpoint cannot be used: " + e.what());
  }
}

}  // namespace fpz::specimen::detail
