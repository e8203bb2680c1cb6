#include "path_file_fuzz.hpp"

#include <cmath>
#include <cstdlib>
#include <string_view>

#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

/// What a reader of the result relies on.
bool is_consistent(const Test& t) {
  if (t.name.empty() || t.stages.empty() || !validate(t.parameters, t.setting).ok()) return false;
  for (const Stage& s : t.stages) {
    if (s.increments < 1 || (s.controls.empty() && s.constraints.empty())) return false;
    for (const ComponentControl& c : s.controls) {
      if (c.component < 0 || c.component > 5 || !std::isfinite(c.value)) return false;
    }
  }
  return true;
}

}  // namespace

void read_as_path_file(const std::uint8_t* data, std::size_t size) {
  // Expanding a million stages is right but slow, and finds nothing that a hundred do not.
  Limits limits;
  limits.stages = 100;
  try {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const PathFile file = parse_path_file(text, "corpus/fuzz.json", limits);
    if (file.tests.empty()) std::abort();
    for (const Test& t : file.tests) {
      if (!is_consistent(t)) std::abort();
    }
  } catch (const InputError& e) {
    if (std::string_view(e.what()).empty()) std::abort();
  }
}

}  // namespace fpz::driver

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fpz::driver::read_as_path_file(data, size);
  return 0;
}
