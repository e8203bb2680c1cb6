// The options of the particle method, as option_table.hpp lists them.
#include "fpz/sph/option_table.hpp"
#include "scene_reader.hpp"

namespace fpz::specimen::detail {
namespace {

/// Reads one option of any type; what is wrong leaves its default.
struct OptionReader {
  const InputReader& r;
  const sph::OptionInfo& info;

  void operator()(const Place& p, double& number) const {
    number = r.number_between(p, info.file.lowest, info.file.highest, true).value_or(number);
  }
  void operator()(const Place& p, int& count) const {
    count = r.integer(p, static_cast<int>(info.file.lowest), static_cast<int>(info.file.highest)).value_or(count);
  }
  void operator()(const Place& p, Point& vector) const { vector = point(r, p).value_or(vector); }
  template <Worded E>
  void operator()(const Place& p, E& word) const {
    word = choice<E>(r, p).value_or(word);
  }
  void operator()(const Place& p, sph::RveLength& length) const {
    if (p.value().is(JsonValue::Kind::number)) {
      length.rule = sph::RveLength::Rule::number;
      length.value = r.positive(p).value_or(1.0);
    } else if (p.value().is(JsonValue::Kind::string)) {
      (*this)(p, length.rule);
    } else {
      r.problem(p, "expected \"spacing\", \"band\" or a number of metres, found " + p.value().description());
    }
  }
};

}  // namespace

void read_method(const InputReader& r, const Place& place, sph::Options<2>& options) {
  if (!r.object(place, "choices of the method")) return;
  std::vector<std::string_view> keys;
  sph::for_each_option(options, [&](const sph::OptionInfo& info, const auto&) { keys.push_back(info.name); });
  r.known_keys(place, keys);
  sph::for_each_option(options, [&](const sph::OptionInfo& info, auto& member) {
    with(place, info.name, [&](const Place& p) { OptionReader{r, info}(p, member); });
  });
}

}  // namespace fpz::specimen::detail
