#include "fpz/io/output.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace fpz::io {
namespace fs = std::filesystem;
namespace {

std::string reason() { return std::strerror(errno); }

/// Hidden, unique to this process, and with the same ending, because gnuplot users may go by it.
fs::path temporary_name(const fs::path& file) {
  std::string name = ".";
  name.append(file.stem().string()).append(".").append(std::to_string(::getpid())).append(file.extension().string());
  return file.parent_path() / name;
}

void write_all(const fs::path& file, std::string_view text) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out) throw OutputError(file.string() + ": cannot be written: " + reason());
  std::string why;
  if (std::fwrite(text.data(), 1, text.size(), out) != text.size() || std::fflush(out) != 0) why = reason();
  if (std::fclose(out) != 0 && why.empty()) why = reason();  // a full disk may show only here
  if (!why.empty()) throw OutputError(file.string() + ": cannot be written: " + why);
}

}  // namespace

void require_absent(const std::vector<fs::path>& files, bool force) {
  if (force) return;
  std::string present;
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(file, ignored))) present += "\n  " + file.string();
  }
  if (!present.empty()) throw OutputError("these files exist already (use --force to replace them):" + present);
}

void make_writable_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder.string() + ": cannot be made: " + error.message());
  if (!fs::is_directory(folder)) throw OutputError(folder.string() + ": is not a folder");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(folder.string() + ": cannot be written to: " + reason());
}

void replace_file(const fs::path& file, bool force, const std::function<void(const fs::path&)>& produce) {
  require_absent({file}, force);
  const fs::path temporary = temporary_name(file);
  std::error_code error;
  try {
    produce(temporary);
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
  fs::rename(temporary, file, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(temporary, error);
    throw OutputError(file.string() + ": cannot be written: " + why);
  }
}

void write_text(const fs::path& file, std::string_view text, bool force) {
  replace_file(file, force, [&](const fs::path& temporary) { write_all(temporary, text); });
}

}  // namespace fpz::io
