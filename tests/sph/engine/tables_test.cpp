// The lists from which readers, checks, fingerprints and reports derive: nothing is missing from them.
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "fpz/sph/option_table.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

/// As many members as the table has entries: the binding does not compile with another number of either.
TEST(OptionTable, HasEveryMember) {
  static_assert(option_count<2> == 21);
  const Options<2> o;
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, p, q, r, s, t, u, v] = o;
  const std::set<const void*> members = {&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k,
                                         &l, &m, &n, &p, &q, &r, &s, &t, &u, &v};
  std::set<const void*> visited;
  std::set<std::string_view> names;
  for_each_option(o, [&](const OptionInfo& info, const auto& member) {
    visited.insert(&member);
    names.insert(info.name);
    EXPECT_FALSE(info.text.empty()) << info.name;
  });
  EXPECT_EQ(visited, members);
  EXPECT_EQ(names.size(), option_count<2>);
}

/// Another admissible value of any option.
struct Change {
  void operator()(double& x) const { x = x > 0.5 ? x * 1.25 : x + 0.125; }
  void operator()(int& x) const { ++x; }
  void operator()(Vector& x) const { x[1] += 1.0; }
  void operator()(RveLength& x) const { x.rule = RveLength::Rule::spacing; }
  template <Worded E>
  void operator()(E& x) const {
    x = Words<E>::list[x == Words<E>::list[0].value ? 1 : 0].value;
  }
};

/// Changes the k-th option; its description.
OptionInfo change(Options<2>& o, std::size_t k) {
  OptionInfo changed;
  std::size_t at = 0;
  for_each_option(o, [&](const OptionInfo& info, auto& member) {
    if (at++ != k) return;
    changed = info;
    Change{}(member);
  });
  return changed;
}

/// A snapshot is refused by a run with any other option, unless the results do not depend on it.
TEST(OptionTable, EveryOptionIsPartOfTheFingerprint) {
  const RunSetup<2> s = block(3, 2);
  const std::vector<unsigned char> bytes = Simulation<2>(s).snapshot();
  std::set<std::string_view> free;
  for (std::size_t k = 0; k < option_count<2>; ++k) {
    RunSetup<2> other = s;
    const OptionInfo info = change(other.options, k);
    ASSERT_TRUE(problems(other).empty()) << info.name << ": " << problems(other).front();
    Simulation<2> run(other);
    if (info.changes_result) {
      EXPECT_THROW(run.restore(bytes), std::runtime_error) << info.name;
    } else {
      free.insert(info.name);
      EXPECT_NO_THROW(run.restore(bytes)) << info.name;
    }
  }
  EXPECT_EQ(free, (std::set<std::string_view>{"threads", "instruction_set"}));
}

/// The length of a rule that is a number counts too.
TEST(OptionTable, TheNumberOfTheLengthIsPartOfTheFingerprint) {
  RunSetup<2> s = block(3, 2);
  s.options.rve_length = {RveLength::Rule::number, 1e-3};
  const std::vector<unsigned char> bytes = Simulation<2>(s).snapshot();
  s.options.rve_length.value = 2e-3;
  Simulation<2> run(s);
  EXPECT_THROW(run.restore(bytes), std::runtime_error);
}

/// Sets a number out of bounds; false where the option is a word.
struct Spoil {
  bool operator()(double& x) const {
    x = -1.0;
    return true;
  }
  bool operator()(int& x) const {
    x = -1;
    return true;
  }
  bool operator()(Vector& x) const {
    x[0] = std::numeric_limits<double>::infinity();
    return true;
  }
  bool operator()(RveLength& x) const {
    x = {RveLength::Rule::number, 0.0};
    return true;
  }
  template <Worded E>
  bool operator()(E&) const {
    return false;
  }
};

TEST(OptionTable, EveryNumberIsChecked) {
  std::size_t numbers = 0;
  for (std::size_t k = 0; k < option_count<2>; ++k) {
    RunSetup<2> s = block(3, 2);
    std::size_t at = 0;
    std::string name;
    for_each_option(s.options, [&](const OptionInfo& info, auto& member) {
      if (at++ == k && Spoil{}(member)) name = info.name;
    });
    if (name.empty()) continue;
    ++numbers;
    ASSERT_EQ(problems(s).size(), 1U) << name;
    EXPECT_NE(problems(s).front().find(name), std::string::npos) << problems(s).front();
  }
  EXPECT_EQ(numbers, 15U);
}

/// What a file may state is what a run accepts.
TEST(OptionTable, FileRangesLieWithinTheBounds) {
  std::size_t ranges = 0;
  for_each_option(Options<2>{}, [&](const OptionInfo& info, const auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, double>) {
      ++ranges;
      EXPECT_TRUE(info.valid.hold(info.file.lowest) && info.valid.hold(info.file.highest)) << info.name;
      EXPECT_TRUE(member >= info.file.lowest && member <= info.file.highest) << info.name;
    }
  });
  EXPECT_EQ(ranges, 12U);
}

template <class E>
void words_are_distinct(std::size_t count) {
  std::set<E> values;
  for (const Word<E>& w : Words<E>::list) {
    EXPECT_EQ(from_word<E>(w.text), w.value);
    values.insert(w.value);
  }
  EXPECT_EQ(values.size(), count);
}

TEST(OptionTable, WordsAreComplete) {
  words_are_distinct<Configuration>(2);
  words_are_distinct<MomentumForm>(2);
  words_are_distinct<Kernel>(2);
  words_are_distinct<RveLength::Rule>(2);
  words_are_distinct<InstructionSet>(4);
}

/// Powers of two, so that each subset of the terms has its own sum.
TEST(EnergyTable, TheErrorIsWhatTheBalanceLacks) {
  const Energies e = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0};
  const auto& [external, elastic, kinetic, fracture, zero_energy, viscous, damping, artificial, contact, friction,
               kinetic_start, elastic_start] = e;
  EXPECT_EQ(energy_terms.size(), 12U);
  EXPECT_EQ(e.error(), external - (elastic - elastic_start + kinetic - kinetic_start + fracture + zero_energy +
                                   viscous + damping + artificial + contact + friction));
}

TEST(EnergyTable, ReportsTheTermsAndTheError) {
  const Energies e = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, 1024.0, 2048.0};
  std::string names;
  std::vector<double> values;
  for_each_energy(e, [&](std::string_view name, double x) {
    names += std::string(name) + ' ';
    values.push_back(x);
  });
  EXPECT_EQ(names, "external elastic kinetic fracture zero_energy viscous damping artificial contact friction error ");
  EXPECT_EQ(values, (std::vector<double>{1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, e.error()}));
}

}  // namespace
}  // namespace fpz::sph::test
