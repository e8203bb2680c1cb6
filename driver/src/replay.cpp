#include "fpz/driver/replay.hpp"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "fpz/capture.hpp"
#include "fpz/driver/dimension.hpp"
#include "fpz/driver/path_file.hpp"
#include "fpz/update.hpp"

namespace fpz::driver {
namespace {

using Json = nlohmann::json;

/// The archive of visit_capture() that reads: the members of one JSON object. Every complaint names the file and the
/// key.
class Reader {
 public:
  Reader(const Json& object, std::string place) : object_(object), place_(std::move(place)) {
    if (!object_.is_object()) throw InputError(place_ + ": not a JSON object");
  }

  template <class F>
  void object(std::string_view key, const F& body) {
    Reader inside(at(key), path(key));
    body(inside);
  }
  void operator()(std::string_view key, double& x) const { x = number(at(key), key); }
  void operator()(std::string_view key, int& x) const {
    const Json& j = at(key);
    if (!j.is_number_integer()) throw InputError(path(key) + ": not an integer");
    x = j.get<int>();
  }
  void operator()(std::string_view key, bool& x) const {
    if (!at(key).is_boolean()) throw InputError(path(key) + ": not true or false");
    x = at(key).get<bool>();
  }
  template <Worded E>
  void operator()(std::string_view key, E& x) const {
    if (!at(key).is_string()) throw InputError(path(key) + ": not a text");
    const auto word = at(key).get<std::string>();
    const std::optional<E> known = from_word<E>(word);
    if (!known) throw InputError(path(key) + ": \"" + word + "\" is none of " + all_words<E>());
    x = *known;
  }
  template <Worded E>
  void choice(std::string_view key, E& x) const {
    if (object_.contains(key)) (*this)(key, x);
  }
  /// A vector, or a matrix written row by row.
  template <class Derived>
  void operator()(std::string_view key, Eigen::PlainObjectBase<Derived>& m) const {
    const Json& j = at(key);
    if (!j.is_array() || static_cast<Eigen::Index>(j.size()) != m.size()) {
      throw InputError(path(key) + ": not an array of " + std::to_string(m.size()) + " numbers");
    }
    for (Eigen::Index i = 0; i < m.size(); ++i) {
      m(i / m.cols(), i % m.cols()) = number(j[static_cast<std::size_t>(i)], key);
    }
  }
  [[nodiscard]] std::string path(std::string_view key) const { return place_ + ", \"" + std::string(key) + "\""; }

 private:
  [[nodiscard]] const Json& at(std::string_view key) const {
    const auto found = object_.find(key);
    if (found == object_.end()) throw InputError(path(key) + " is missing");
    return *found;
  }
  [[nodiscard]] double number(const Json& j, std::string_view key) const {
    if (j.is_number()) return j.get<double>();
    if (j == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (j == "inf") return std::numeric_limits<double>::infinity();
    if (j == "-inf") return -std::numeric_limits<double>::infinity();
    throw InputError(path(key) + ": not a number");
  }

  const Json& object_;
  std::string place_;
};

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
Replay repeat(Reader& reader) {
  Capture<Dim> c;
  visit_capture(reader, c);
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
  Reader reader(json, file.string());
  int version = 0;
  reader("fpz_capture", version);
  if (version != capture_version) {
    throw InputError(reader.path("fpz_capture") + ": only version " + std::to_string(capture_version) + " is known");
  }
  Setting setting{};
  reader("setting", setting);
  return with_dimension(setting, [&](auto dim) { return repeat<decltype(dim)::value>(reader); });
}

}  // namespace fpz::driver
