#include "fpz/state_fields.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace fpz {
namespace {

/// Counts bytes of the visited fields, and their names.
struct Sizes {
  std::size_t bytes = 0;
  std::set<std::string> names;
  std::size_t fields = 0;

  template <class Field>
  void operator()(const char* name, const Field&) {
    bytes += sizeof(Field);
    names.insert(name);
    ++fields;
  }
};

template <int Dim>
void expect_every_byte_visited() {
  const State<double, Dim> s;
  Sizes sizes;
  visit_point(s, sizes);
  visit_crack(s, sizes);
  // All fields are doubles but one flag, which the compiler fills up to the size of a double.
  EXPECT_EQ(sizes.bytes - sizeof(bool) + sizeof(double), sizeof s);
  EXPECT_EQ(sizes.names.size(), sizes.fields);
}

TEST(StateFields, NoneIsForgotten) {
  expect_every_byte_visited<2>();
  expect_every_byte_visited<3>();
}

TEST(StateFields, AreTheMembersThemselves) {
  State3 s;
  visit_point(s, [&](std::string_view name, auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, bool>) {
      field = true;
    } else {
      field.setConstant(name == "strain" ? 1.0 : 2.0);
    }
  });
  EXPECT_EQ(s.strain[5], 1.0);
  EXPECT_EQ(s.stress[0], 2.0);
  EXPECT_TRUE(s.cracked);
}

}  // namespace
}  // namespace fpz
