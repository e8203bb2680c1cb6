#include "fpz/capture.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

namespace fpz {

namespace {

std::string number(double x) {
  if (!std::isfinite(x)) return std::isnan(x) ? "\"nan\"" : (x > 0.0 ? "\"inf\"" : "\"-inf\"");
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

/// A JSON object or array body, one entry a line.
class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) {}

  void open(const char* key, char bracket) {
    line(key);
    out_ << bracket;
    first_ = true;
    ++depth_;
  }
  void close(char bracket) {
    --depth_;
    out_ << '\n' << std::string(static_cast<std::size_t>(2 * depth_), ' ') << bracket;
    first_ = false;
  }
  void raw(const char* key, const std::string& text) {
    line(key);
    out_ << text;
  }
  void entry(const char* key, double x) { raw(key, number(x)); }
  void text(const char* key, const char* value) { raw(key, std::string("\"") + value + "\""); }
  template <class Derived>
  void entry(const char* key, const Eigen::DenseBase<Derived>& a) {
    std::string list = "[";
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      for (Eigen::Index j = 0; j < a.cols(); ++j) list += (list.size() > 1 ? ", " : "") + number(a(i, j));
    }
    raw(key, list + "]");
  }

 private:
  void line(const char* key) {
    if (depth_ > 0) out_ << (first_ ? "\n" : ",\n") << std::string(static_cast<std::size_t>(2 * depth_), ' ');
    if (*key != '\0') out_ << '"' << key << "\": ";
    first_ = false;
  }

  std::ostream& out_;
  bool first_ = true;
  int depth_ = 0;
};

void write_parameters(Writer& w, const Parameters& p) {
  w.open("material", '{');
  w.entry("young_modulus", p.young_modulus);
  w.entry("poisson_ratio", p.poisson_ratio);
  w.entry("density", p.density);
  w.entry("tensile_strength", p.tensile_strength);
  w.entry("cohesion", p.cohesion);
  w.entry("friction_angle_deg", p.friction_angle_deg);
  w.entry("dilation_angle_deg", p.dilation_angle_deg);
  w.entry("delta0", p.delta0);
  w.entry("normal_stiffness", p.normal_stiffness);
  w.entry("shear_stiffness", p.shear_stiffness);
  w.close('}');
  w.entry("rve_length", p.rve_length);
}

void write_options(Writer& w, const Options& o) {
  w.open("integrator", '{');
  w.text("name", to_string(o.method));
  w.entry("tolerance", o.tolerance);
  w.entry("max_iterations", o.max_iterations);
  w.entry("max_substeps", o.max_substeps);
  w.entry("scan_degrees", o.scan_resolution_deg);
  w.entry("preferred_normal", o.preferred_normal);
  w.close('}');
}

template <int Dim>
void write_state(Writer& w, const State<double, Dim>& s) {
  w.open("begin", '{');
  w.entry("strain", s.strain);
  w.entry("stress", s.stress);
  w.raw("cracked", s.cracked ? "true" : "false");
  if (s.cracked) {
    w.entry("frame", s.frame);  // rows n, s1[, s2]
    w.entry("traction", s.crack.traction);
    w.entry("jump", s.crack.jump);
    w.entry("plastic_jump", s.crack.plastic_jump);
    w.entry("offset", s.crack.offset);
    w.entry("slip", s.crack.slip);
    w.entry("integrity", s.crack.integrity);
    w.entry("dissipated", s.crack.dissipated);
  }
  w.close('}');
}

}  // namespace

template <int Dim>
bool write_capture(const std::filesystem::path& file, const Capture<Dim>& c) {
  std::filesystem::path draft = file;
  draft += ".part";
  {
    std::ofstream out(draft);
    Writer w(out);
    w.open("", '{');
    w.entry("fpz_capture", 1);
    w.text("setting", to_string(c.setting));
    write_parameters(w, c.parameters);
    write_options(w, c.options);
    write_state(w, c.begin);
    w.entry("strain_increment", c.strain_increment);
    w.text("status", to_string(c.status));
    w.close('}');
    out << '\n';
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
