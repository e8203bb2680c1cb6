#include "run_folder.hpp"

#include <system_error>

#include "fpz/io/output.hpp"

namespace fpz::specimen {

namespace fs = std::filesystem;

RunFiles::RunFiles(const fs::path& folder)
    : scene(folder / "scene.json"),
      history(folder / "history.csv"),
      summary(folder / "summary.json"),
      checkpoint(folder / "checkpoint.bin"),
      crack(folder / "crack.csv"),
      frames(folder / "frames"),
      collection(folder / "frames.pvd") {}

namespace detail {

void clear_earlier_run(const RunFiles& files) {
  std::error_code ignored;
  for (const fs::path& f : {files.history, files.summary, files.checkpoint, files.crack}) fs::remove(f, ignored);
  for (const auto& entry : fs::directory_iterator(files.frames, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame_") && entry.path().extension() == ".vtu") fs::remove(entry.path(), ignored);
  }
}

void remove_leftovers(const fs::path& folder, const RunFiles& files) {
  std::error_code ignored;
  for (const fs::path& place : {folder, files.frames}) {
    for (const auto& entry : fs::directory_iterator(place, ignored)) {
      const std::string name = entry.path().filename().string();
      for (const char* stem : {".scene.", ".history.", ".summary.", ".checkpoint.", ".crack.", ".frame"}) {
        if (name.starts_with(stem)) fs::remove(entry.path(), ignored);
      }
    }
  }
}

void require_space(const fs::path& folder, double bytes) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  if (!error && static_cast<double>(space.available) < bytes) {
    throw io::OutputError(folder.string() + ": the disk has " + std::to_string(space.available >> 20U) +
                          " MiB left, this run needs about " +
                          std::to_string(static_cast<long long>(bytes / 1048576.0)) +
                          " MiB (output.frames sets most of it)");
  }
}

}  // namespace detail
}  // namespace fpz::specimen
