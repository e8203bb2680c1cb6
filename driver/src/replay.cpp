#include "fpz/driver/replay.hpp"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fpz/capture.hpp"
#include "fpz/driver/dimension.hpp"
#include "fpz/driver/path_file.hpp"

namespace fpz::driver {
namespace {

using Json = nlohmann::json;

/// Reads the members of one JSON object; every complaint names the file and the key.
class Reader {
 public:
  Reader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {
    if (!object_.is_object()) throw InputError(place_ + ": not a JSON object");
  }

  [[nodiscard]] const Json& at(const char* key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) throw InputError(path(key) + " is missing");
    return *found;
  }
  [[nodiscard]] Reader object(const char* key) const { return {at(key), path(key)}; }
  [[nodiscard]] double number(const char* key) const { return number(at(key), key); }
  [[nodiscard]] int integer(const char* key) const {
    const Json& j = at(key);
    if (!j.is_number_integer()) throw InputError(path(key) + ": not an integer");
    return j.get<int>();
  }
  [[nodiscard]] bool boolean(const char* key) const {
    if (!at(key).is_boolean()) throw InputError(path(key) + ": not true or false");
    return at(key).get<bool>();
  }
  [[nodiscard]] std::string text(const char* key) const {
    if (!at(key).is_string()) throw InputError(path(key) + ": not a text");
    return at(key).get<std::string>();
  }
  /// A vector, or a matrix written row by row.
  template <class Matrix>
  void fill(const char* key, Matrix& m) const {
    const Json& j = at(key);
    if (!j.is_array() || static_cast<Eigen::Index>(j.size()) != m.size()) {
      throw InputError(path(key) + ": not an array of " + std::to_string(m.size()) + " numbers");
    }
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      m(i / m.cols(), i % m.cols()) = number(j[static_cast<std::size_t>(i)], key);
    }
  }
  [[nodiscard]] std::string path(const char* key) const { return place_ + ", \"" + key + "\""; }

 private:
  [[nodiscard]] double number(const Json& j, const char* key) const {
    if (j.is_number()) return j.get<double>();
    if (j == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (j == "inf") return std::numeric_limits<double>::infinity();
    if (j == "-inf") return -std::numeric_limits<double>::infinity();
    throw InputError(path(key) + ": not a number");
  }

  const Json& object_;
  std::string place_;
};

template <class Enum>
Enum named(const Reader& r, const char* key, std::initializer_list<Enum> values) {
  const std::string name = r.text(key);
  std::string known;
  for (const Enum e : values) {
    if (name == to_string(e)) return e;
    known.append(" ").append(to_string(e));
  }
  throw InputError(r.path(key) + ": \"" + name + "\" is none of" + known);
}

Setting read_setting(const Reader& r) {
  return named(r, "setting", {Setting::plane_strain, Setting::plane_stress, Setting::three_d});
}

Parameters read_parameters(const Reader& r) {
  const Reader m = r.object("material");
  Parameters p;
  p.young_modulus = m.number("young_modulus");
  p.poisson_ratio = m.number("poisson_ratio");
  p.density = m.number("density");
  p.tensile_strength = m.number("tensile_strength");
  p.cohesion = m.number("cohesion");
  p.friction_angle_deg = m.number("friction_angle_deg");
  p.dilation_angle_deg = m.number("dilation_angle_deg");
  p.delta0 = m.number("delta0");
  p.normal_stiffness = m.number("normal_stiffness");
  p.shear_stiffness = m.number("shear_stiffness");
  p.rve_length = r.number("rve_length");
  return p;
}

Options read_options(const Reader& r) {
  Options o;
  o.method = named(r, "name", {Method::paper, Method::implicit, Method::accurate});
  o.tolerance = r.number("tolerance");
  o.max_iterations = r.integer("max_iterations");
  o.max_substeps = r.integer("max_substeps");
  o.scan_resolution_deg = r.number("scan_degrees");
  r.fill("preferred_normal", o.preferred_normal);
  return o;
}

template <int Dim>
Capture<Dim> read_capture(const Reader& r) {
  Capture<Dim> c;
  c.parameters = read_parameters(r);
  c.setting = read_setting(r);
  c.options = read_options(r.object("integrator"));
  const Reader b = r.object("begin");
  b.fill("strain", c.begin.strain);
  b.fill("stress", c.begin.stress);
  c.begin.cracked = b.boolean("cracked");
  if (c.begin.cracked) {
    b.fill("frame", c.begin.frame);
    b.fill("traction", c.begin.crack.traction);
    b.fill("jump", c.begin.crack.jump);
    b.fill("plastic_jump", c.begin.crack.plastic_jump);
    b.fill("offset", c.begin.crack.offset);
    c.begin.crack.slip = b.number("slip");
    c.begin.crack.integrity = b.number("integrity");
    c.begin.crack.dissipated = b.number("dissipated");
  }
  r.fill("strain_increment", c.strain_increment);
  c.status =
      named(r, "status",
            {Status::ok, Status::non_convergence, Status::snap_back, Status::no_plastic_flow, Status::invalid_input});
  return c;
}

template <int Dim>
void describe(std::ostream& out, const char* name, const State<double, Dim>& s) {
  out << name << "\n  strain        " << s.strain.transpose() << "\n  stress        " << s.stress.transpose() << "\n";
  if (!s.cracked) {
    out << "  not cracked\n";
    return;
  }
  out << "  normal        " << s.frame.row(0) << "\n  traction      " << s.crack.traction.transpose()
      << "\n  jump          " << s.crack.jump.transpose() << "\n  plastic jump  " << s.crack.plastic_jump.transpose()
      << "\n  D             " << damage(s) << "\n";
}

template <int Dim>
Replay repeat(const Reader& reader) {
  const Capture<Dim> c = read_capture<Dim>(reader);
  const Material<double> material = make_material(c.parameters, c.setting);
  Replay out;
  out.captured = c.status;
  std::ostringstream text;
  text.precision(10);
  const Validation validation = validate(c.parameters, c.setting);
  text << validation.report();
  describe<Dim>(text, "begin", c.begin);
  text << "strain increment\n  " << c.strain_increment.transpose() << "\n";
  bool first = true;
  for (const Method method : {c.options.method, Method::accurate, Method::implicit, Method::paper}) {
    if (!first && method == c.options.method) continue;
    Options options = c.options;
    options.method = method;
    State<double, Dim> end;
    const Report report = update<Dim>(material, options, c.begin, c.strain_increment, end);
    text << (first ? "captured integrator \"" : "for comparison, \"") << to_string(method)
         << "\": " << to_string(report.status) << ", " << report.iterations << " iterations, " << report.substeps
         << " substeps";
    if (first) {
      out.now = report.status;
      text << (report.status == c.status ? " (as captured)" : std::string(" (captured: ") + to_string(c.status) + ")");
    }
    first = false;
    text << "\n";
    if (report.ok()) describe<Dim>(text, "end", end);
  }
  out.text = text.str();
  return out;
}

}  // namespace

Replay replay(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw InputError(file.string() + ": cannot be read");
  const Json json = Json::parse(in, nullptr, false);
  if (json.is_discarded()) throw InputError(file.string() + ": not JSON");
  const Reader reader(json, file.string());
  if (reader.integer("fpz_capture") != 1) throw InputError(reader.path("fpz_capture") + ": only version 1 is known");
  return with_dimension(read_setting(reader), [&](auto dim) { return repeat<decltype(dim)::value>(reader); });
}

}  // namespace fpz::driver
