#include "fpz/capture.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace fpz {

namespace {

std::string number(double x) {
  if (!std::isfinite(x)) return std::isnan(x) ? "\"nan\"" : (x > 0.0 ? "\"inf\"" : "\"-inf\"");
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

/// The archive of visit_capture() that writes JSON objects, one entry a line.
class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  /// The whole file: one object without a key.
  template <class F>
  void root(const F& body) {
    braces(body);
    out_ << '\n';
  }
  template <class F>
  void object(std::string_view key, const F& body) {
    line(key);
    braces(body);
  }
  void operator()(std::string_view key, double x) { entry(key, number(x)); }
  void operator()(std::string_view key, int x) { entry(key, std::to_string(x)); }
  void operator()(std::string_view key, bool x) { entry(key, x ? "true" : "false"); }
  template <Worded E>
  void operator()(std::string_view key, E x) {
    entry(key, std::string("\"") + to_string(x) + "\"");
  }
  template <class Derived>
  void operator()(std::string_view key, const Eigen::DenseBase<Derived>& a) {
    std::string list = "[";
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      for (Eigen::Index j = 0; j < a.cols(); ++j) list += (list.size() > 1 ? ", " : "") + number(a(i, j));
    }
    entry(key, list + "]");
  }

  template <Worded E>
  void choice(std::string_view key, E x) {
    if (x != E{}) (*this)(key, x);
  }

 private:
  template <class F>
  void braces(const F& body) {
    out_ << '{';
    first_ = true;
    ++depth_;
    body(*this);
    --depth_;
    out_ << '\n' << indent() << '}';
    first_ = false;
  }
  void entry(std::string_view key, const std::string& text) {
    line(key);
    out_ << text;
  }
  void line(std::string_view key) {
    out_ << (first_ ? "\n" : ",\n") << indent() << '"' << key << "\": ";
    first_ = false;
  }
  [[nodiscard]] std::string indent() const { return std::string(static_cast<std::size_t>(2 * depth_), ' '); }

  std::ostream& out_;
  bool first_ = true;
  int depth_ = 0;
};

}  // namespace

template <int Dim>
bool write_capture(const std::filesystem::path& file, const Capture<Dim>& c) {
  std::filesystem::path draft = file;
  draft += ".part";
  {
    std::ofstream out(draft);
    Writer(out).root([&c](Writer& w) {
      w("fpz_capture", capture_version);
      visit_capture(w, c);
    });
    out.close();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(draft, ignored);
      return false;
    }
  }
  std::error_code failed;
  std::filesystem::rename(draft, file, failed);
  return !failed;
}

template bool write_capture<2>(const std::filesystem::path&, const Capture<2>&);
template bool write_capture<3>(const std::filesystem::path&, const Capture<3>&);

}  // namespace fpz
