// The program gnuplot: is it there, what it needs to have escaped, and a script run into a file.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace fpz::io {

[[nodiscard]] bool gnuplot_is_installed();

/// A string literal of gnuplot; control characters are left out.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

/// Text that gnuplot's enhanced mode shows as it is: an underscore is no subscript.
[[nodiscard]] std::string gnuplot_plain(const std::string& text);

/// A number as gnuplot reads it, ten significant digits.
[[nodiscard]] std::string gnuplot_number(double x);

/// Lets gnuplot draw `file`: `script` writes commands (terminal first; `set output` has been sent). The picture appears
/// under its name when it is complete. Throws OutputError when it does not come out or may not be replaced; a gnuplot
/// that dies does not take this process along.
void draw_with_gnuplot(const std::filesystem::path& file, bool force, const std::function<void(std::ostream&)>& script);

}  // namespace fpz::io
