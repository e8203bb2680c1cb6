#include "fpz/point/notice.hpp"

#include <cstdio>
#include <mutex>
#include <set>

namespace fpz::point {

void notice(const std::string& text) noexcept {
  static std::mutex guard;
  static std::set<std::string> said;
  try {
    const std::lock_guard lock(guard);
    if (static_cast<int>(said.size()) > most_notices || !said.insert(text).second) return;
    const bool last = static_cast<int>(said.size()) > most_notices;
    std::fprintf(stderr, "fpz: %s\n", last ? "no more of these notices are printed" : text.c_str());
  } catch (...) {  // no memory for the text: there is nobody else to tell
  }
}

}  // namespace fpz::point
