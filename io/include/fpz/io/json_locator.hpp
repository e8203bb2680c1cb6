// JSON text as a tree in which every value knows its line, so that a later complaint about its meaning can name the
// place. nlohmann's own tree has no positions; this one is built from its SAX parser.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fpz/io/input_error.hpp"
#include "fpz/io/problems.hpp"

namespace fpz::io {

struct JsonValue {
  enum class Kind : unsigned char { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  std::size_t line = 0;          ///< counted from 1
  double number = 0.0;           ///< the double nearest to the decimal number, as strtod gives it
  std::string text;              ///< of a string its value, of a number its spelling in the file
  std::string key;               ///< the value's name when its parent is an object
  std::vector<JsonValue> items;  ///< elements of an array or members of an object, in the order of the file

  [[nodiscard]] bool is(Kind k) const { return kind == k; }
  /// The member of that name, or null.
  [[nodiscard]] const JsonValue* find(std::string_view name) const;
  /// "the string \"1e-3\"", "an array", ...: what was found in place of what should be there.
  [[nodiscard]] std::string description() const;
};

/// A value and the way to it from the root, rendered only when a message needs it. Refers to the parent's Place, so it
/// must not outlive it.
class Place {
 public:
  explicit Place(const JsonValue& root) : value_(&root) {}
  Place(const Place& parent, const JsonValue& child) : parent_(&parent), value_(&child) {}

  [[nodiscard]] const JsonValue& value() const { return *value_; }
  [[nodiscard]] std::size_t line() const { return value_->line; }
  /// "stages[1].strain_increment.xx"; empty for the root.
  [[nodiscard]] std::string path() const;

 private:
  const Place* parent_ = nullptr;
  const JsonValue* value_;
};

/// Parses strict JSON (RFC 8259: no comments, no NaN). Syntax errors, excesses of the limits, and duplicate keys become
/// problems of `file`; false when there is no tree to look at.
[[nodiscard]] bool parse_json(std::string_view text, const std::string& file, const ReadLimits& limits,
                              Problems& problems, JsonValue& root);

enum class FileKind { regular, any };

/// Reads a whole file. On failure (missing, a folder, larger than limits.bytes) false and the reason in `error`. A file
/// that another file names must be a regular one: opening a pipe would wait for ever.
[[nodiscard]] bool load_text(const std::filesystem::path& path, FileKind kind, const ReadLimits& limits,
                             std::string& text, std::string& error);

}  // namespace fpz::io
