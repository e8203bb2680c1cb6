// A word to the person at the terminal, for interfaces that have no other way to say anything.
#pragma once

#include <string>

namespace fpz::point {

/// Most texts that one process prints.
inline constexpr int most_notices = 20;

/// Prints "fpz: <text>" to the standard error stream: each text once, and most_notices in all, so that a run that fails
/// everywhere does not fill its log. Never throws.
void notice(const std::string& text) noexcept;

}  // namespace fpz::point
