// What a program tells the person in front of it besides its results.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace fpz::io {

/// One line "warning: ..." each, on stderr.
void print_warnings(const std::vector<std::string>& warnings);

/// What a person should know and that is not doubtful.
void print_notes(const std::vector<std::string>& notes);

/// Seconds as 1:05 or 2:00:05.
[[nodiscard]] std::string clock_text(double seconds);

/// One line on stderr that is written over again and again, and wiped at the end; nothing when stderr is no terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  [[nodiscard]] bool on_terminal() const { return terminal_; }
  /// Seconds since the beginning.
  [[nodiscard]] double elapsed() const;
  /// Whether the line is to be shown now: at most four times a second.
  [[nodiscard]] bool due();
  void show(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_{};
};

}  // namespace fpz::io
