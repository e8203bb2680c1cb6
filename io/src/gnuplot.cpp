#include "fpz/io/gnuplot.hpp"

#include <gnuplot-iostream.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "fpz/io/output.hpp"

namespace fpz::io {
namespace {

/// While it lives, a gnuplot that dies does not take this process along.
class IgnoreBrokenPipe {
 public:
  IgnoreBrokenPipe() : previous_(std::signal(SIGPIPE, SIG_IGN)) {}
  ~IgnoreBrokenPipe() { std::signal(SIGPIPE, previous_); }
  IgnoreBrokenPipe(const IgnoreBrokenPipe&) = delete;
  IgnoreBrokenPipe& operator=(const IgnoreBrokenPipe&) = delete;

 private:
  void (*previous_)(int);
};

}  // namespace

bool gnuplot_is_installed() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access(((folder.empty() ? "." : folder) + "/gnuplot").c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < ' ') continue;
    out += c;
    if (c == '\'') out += c;
  }
  return out + "'";
}

std::string gnuplot_plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string gnuplot_number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", x);
  return text;
}

void draw_with_gnuplot(const std::filesystem::path& file, bool force,
                       const std::function<void(std::ostream&)>& script) {
  const IgnoreBrokenPipe guard;
  replace_file(file, force, [&](const std::filesystem::path& temporary) {
    {
      Gnuplot gp("gnuplot");
      gp << "set output " << gnuplot_quoted(temporary.string()) << "\n";
      script(gp);
      gp << "unset output\n" << std::flush;
    }  // waits for gnuplot
    std::error_code error;
    const auto size = std::filesystem::file_size(temporary, error);
    if (error || size == 0) throw OutputError(file.string() + ": gnuplot did not draw it (is gnuplot-nox installed?)");
  });
}

}  // namespace fpz::io
