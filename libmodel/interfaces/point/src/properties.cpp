#include "fpz/point/properties.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fpz/law/softening.hpp"

namespace fpz::point {

namespace {

/// "0 (accurate), 1 (implicit) or 2 (paper)"
template <Worded E>
std::string numbered_words() {
  std::string text;
  const std::size_t size = std::size(Words<E>::list);
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0) text += k + 1 == size ? " or " : ", ";
    text += std::to_string(k) + " (" + Words<E>::list[k].text + ")";
  }
  return text;
}

/// Visits statement s in the order of the list: number(name, parameter info, x), word(name, x) for choices of the
/// material, option(name, x) for numbers and words of the integrator.
template <class S, class Archive>
void visit_statement(S& s, Archive&& archive) {
  for (const ParameterInfo<double>& p : parameter_table<double>) archive.parameter(p, s.parameters.*p.member);
  visit_choices(s.parameters.choices, [&](const char* key, auto& x) { archive.word(key, x); });
  visit_options(s.options, [&](const char* key, auto& x) {
    const std::string name = std::string("integrator_") + key;
    if constexpr (Worded<std::decay_t<decltype(x)>>) {
      archive.word(name, x);
    } else if constexpr (requires { x.size(); }) {
      for (int k = 0; k < 3; ++k) archive.option(name + "_" + "xyz"[k], x[k]);
    } else {
      archive.option(name, x);
    }
  });
}

std::string exact(double x) {
  char text[40];
  const auto result = std::to_chars(text, text + sizeof text, x);
  return {text, result.ptr};
}

class Lister {
 public:
  void parameter(const ParameterInfo<double>& p, const double&) {
    const bool of_place = !p.of_material;
    list.push_back({std::string(p.name), std::string(p.unit), !of_place && !p.bounds.hold(0.0), 0.0, p.bounds.text()});
  }
  template <Worded E>
  void word(const std::string& name, const E&) {
    list.push_back({name, "", false, 0.0, numbered_words<E>()});
  }
  template <class T>
  void option(const std::string& name, const T& x) {
    list.push_back({name, "", false, double(x), ""});
  }
  std::vector<Property> list;
};

class Reader {
 public:
  Reader(std::span<const double> list, double rve_length) : list_(list), rve_length_(rve_length) {}

  void parameter(const ParameterInfo<double>& p, double& x) {
    x = next();
    if (!p.of_material && x == 0.0) x = rve_length_;
  }
  template <Worded E>
  void word(const std::string& name, E& x) {
    const double number = next();
    for (std::size_t k = 0; k < std::size(Words<E>::list); ++k) {
      if (number == double(k)) {
        x = Words<E>::list[k].value;
        return;
      }
    }
    fault(name, number, "must be " + numbered_words<E>());
  }
  void option(const std::string&, double& x) {
    const double number = next();
    if (number != 0.0) x = number;
  }
  void option(const std::string& name, int& x) {
    const double number = next();
    if (number == 0.0) return;
    if (number == std::floor(number) && std::abs(number) < std::numeric_limits<int>::max()) {
      x = static_cast<int>(number);
    } else {
      fault(name, number, "must be an integer");
    }
  }
  std::string faults;

 private:
  double next() { return at_ < list_.size() ? list_[at_++] : (++at_, 0.0); }
  void fault(const std::string& name, double number, const std::string& constraint) {
    faults += "property " + std::to_string(at_) + ", " + name + " = " + exact(number) + ": " + constraint + '\n';
  }

  std::span<const double> list_;
  double rve_length_;
  std::size_t at_ = 0;
};

class Writer {
 public:
  void parameter(const ParameterInfo<double>&, const double& x) { list.push_back(x); }
  template <Worded E>
  void word(const std::string&, const E& x) {
    std::size_t k = 0;
    while (Words<E>::list[k].value != x) ++k;
    list.push_back(double(k));
  }
  template <class T>
  void option(const std::string&, const T& x) {
    list.push_back(double(x));
  }
  std::vector<double> list;
};

}  // namespace

const std::vector<Property>& properties() {
  static const std::vector<Property> list = [] {
    const Statement defaults;
    Lister lister;
    visit_statement(defaults, lister);
    return lister.list;
  }();
  return list;
}

Statement read_properties(std::span<const double> list, double rve_length) {
  if (list.size() > property_count) {
    throw std::invalid_argument(std::to_string(list.size()) + " properties are given, and only " +
                                std::to_string(property_count) + " are known: the last one is " +
                                properties().back().name);
  }
  Statement s;
  Reader reader(list, rve_length);
  visit_statement(s, reader);
  if (!reader.faults.empty()) throw std::invalid_argument(reader.faults);
  return s;
}

std::vector<double> write_properties(const Statement& statement) {
  Writer writer;
  visit_statement(statement, writer);
  return writer.list;
}

}  // namespace fpz::point
