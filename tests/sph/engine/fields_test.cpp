// The declarations of the fields are true: what is not saved is constant or made anew before it is read.
#include <cstring>
#include <map>
#include <string>

#include "engine.hpp"
#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using detail::Engine;
using detail::Extent;
using detail::FieldInfo;
using detail::Keep;

struct Copy {
  Keep keep;
  std::vector<std::vector<double>> components;  ///< of real particles, or blocks
};

/// All fields of a run by name.
std::map<std::string, Copy> fields_of(const Engine<2>& e) {
  std::map<std::string, Copy> all;
  const auto copy = [&](const FieldInfo& info, const auto& field, auto) {
    Copy& c = all[info.name];
    c.keep = info.keep;
    const auto add = [&](const auto& component) {
      const std::size_t size = info.extent == Extent::particle ? e.run.particles.count : component.size();
      ASSERT_LE(size, component.size()) << info.name;
      c.components.emplace_back(component.begin(), component.begin() + static_cast<std::ptrdiff_t>(size));
    };
    using F = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<F, Field> || std::is_same_v<F, detail::Mask>) {
      add(field);
    } else {
      for (const Field& component : field) add(component);
    }
  };
  detail::RunData<2>::fields(e.run, copy);
  if (e.control) detail::ZeroEnergyControl<2>::fields(*e.control, copy);
  return all;
}

bool same_bits(const Copy& a, const Copy& b) {
  if (a.components.size() != b.components.size()) return false;
  for (std::size_t c = 0; c < a.components.size(); ++c) {
    const std::vector<double>& x = a.components[c];
    const std::vector<double>& y = b.components[c];
    if (x.size() != y.size() || std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) != 0) return false;
  }
  return true;
}

void advance(Engine<2>& e, int steps) {
  for (int k = 0; k < steps; ++k) {
    const Outcome o = e.step();
    ASSERT_TRUE(o.ok()) << o.message();
  }
}

std::vector<unsigned char> saved(const Engine<2>& e) {
  Writer w(1);
  e.save(w);
  return std::move(w).sealed();
}

class Fields : public testing::TestWithParam<std::size_t> {
 protected:
  /// Cracks, damping, gravity, a load and, in the reference configuration, zero-energy control.
  static RunSetup<2> setup() {
    RunSetup<2> s = torn(variants[GetParam()]);
    s.options.gravity = vec(50.0, -1e3);
    Load<2> load{"push", {}, TimeTable::rise(0.0, 1.0, 1e-5)};
    for (const int g : s.arrangement.group) load.force.push_back(vec(0.0, g < 0 ? 1.0 : 0.0));
    s.loads.push_back(load);
    return s;
  }
};

TEST_P(Fields, ConstantOnesDoNotChange) {
  const RunSetup<2> s = setup();
  Engine<2> e(s, time_step(s));
  const auto before = fields_of(e);
  advance(e, 150);
  const auto after = fields_of(e);
  std::size_t constant = 0;
  for (const auto& [name, field] : before) {
    if (field.keep != Keep::constant) continue;
    ++constant;
    EXPECT_TRUE(same_bits(field, after.at(name))) << name;
  }
  EXPECT_EQ(constant, 4U);  // start, mass, inverse_mass, damping
}

/// Read back into a fresh run, saved and constant fields are there and passing ones are not; after as many further
/// steps as the zero-energy control rests at most, all are. A field that is needed but declared as passing would spoil
/// the others.
TEST_P(Fields, AreAllThereAfterARestore) {
  const RunSetup<2> s = setup();
  Engine<2> whole(s, time_step(s));
  advance(whole, 150);
  const std::vector<unsigned char> bytes = saved(whole);
  Engine<2> continued(s, time_step(s));
  Reader r(bytes, 1);
  continued.load(r);
  EXPECT_EQ(r.left(), 0U);
  const auto expected = fields_of(whole);
  std::size_t passing = 0;
  for (const auto& [name, field] : fields_of(continued)) {
    passing += field.keep == Keep::passing ? 1U : 0U;
    EXPECT_EQ(same_bits(field, expected.at(name)), field.keep != Keep::passing) << name;
  }
  EXPECT_EQ(passing, 3U);
  advance(whole, 20);
  advance(continued, 20);
  const auto later = fields_of(whole);
  EXPECT_FALSE(same_bits(later.at("position"), expected.at("position")));
  for (const auto& [name, field] : fields_of(continued)) EXPECT_TRUE(same_bits(field, later.at(name))) << name;
  EXPECT_EQ(saved(continued), saved(whole));
}

TEST_P(Fields, AnEngineHasTheTimeStepOfItsSetup) {
  const RunSetup<2> s = setup();
  EXPECT_EQ(Simulation<2>(s).time_step(), time_step(s));
}

/// It is measured on the body of the run itself.
TEST(StabilityLimit, LeavesTheStateAsItWas) {
  for (const Variant& v : variants) {
    if (v.configuration != Configuration::reference) continue;
    const RunSetup<2> s = torn(v);
    Engine<2> e(s, time_step(s));
    advance(e, 150);
    const std::vector<unsigned char> before = saved(e);
    EXPECT_GT(e.stability_limit(), 0.0);
    EXPECT_EQ(saved(e), before);
  }
}

/// Every field that the loops see has its memory, and padding has what is harmless.
TEST_P(Fields, AreAllocatedAndPointedTo) {
  RunSetup<2> s = setup();
  s.arrangement.add(vec(30.5e-3, 0.5e-3), 1e-6);
  Engine<2> e(s, 1e-8);
  const Particles<2>& p = e.run.particles;
  ASSERT_NE(p.count % lanes, 0U);
  const detail::View<2>& v = e.run.view;
  EXPECT_EQ(v.velocity[1], p.velocity[1].data());
  EXPECT_EQ(v.volume, p.volume.data());
  EXPECT_EQ(v.damping_work, e.run.ledger.damping.data());
  const auto check = [&](const FieldInfo& info, const auto& field, auto) {
    using F = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<F, Field>) {
      if (info.extent == Extent::particle) {
        ASSERT_EQ(field.size(), p.padded()) << info.name;
        EXPECT_EQ(field.back(), info.fill) << info.name;
      }
    }
  };
  detail::RunData<2>::fields(e.run, check);
  advance(e, 3);
  EXPECT_EQ(p.velocity[0].back(), 0.0);
  EXPECT_EQ(p.kind.back(), kind::elastic);
}

INSTANTIATE_TEST_SUITE_P(Variants, Fields, testing::Range<std::size_t>(0, std::size(variants)));

}  // namespace
}  // namespace fpz::sph::test
