// Files out: written under a temporary name and renamed, so that a reader never sees half a file.
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fpz::io {

/// A file that could not be written: what() names it and says why.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws OutputError naming every file that exists already, unless `force`.
void require_absent(const std::vector<std::filesystem::path>& files, bool force);

/// Makes the folder with its parents and checks that files can be written there.
void make_writable_folder(const std::filesystem::path& folder);

/// Lets `produce` write a temporary file next to `file`, then renames it. `produce` throws when it fails; the temporary
/// file is removed then. Refuses to write over `file` unless `force`.
void replace_file(const std::filesystem::path& file, bool force,
                  const std::function<void(const std::filesystem::path& temporary)>& produce);

/// Writes text through replace_file. A full disk is noticed.
void write_text(const std::filesystem::path& file, std::string_view text, bool force);

}  // namespace fpz::io
