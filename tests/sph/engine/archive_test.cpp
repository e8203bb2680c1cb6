// Bytes of snapshots and checkpoints: what is written is read, and nothing else is.
#include "fpz/sph/archive.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace fpz::sph::test {

struct Inner {
  double number = 0.0;
  std::string text;
};
template <class A, class T>
requires std::same_as<std::remove_const_t<T>, Inner>
void transfer(A& archive, T& x) {
  archive(x.number);
  archive(x.text);
}

namespace {

enum class Colour : std::uint8_t { red, green };

struct Content {
  std::vector<Inner> inners = {{1.5, "one"}, {-0.0, ""}};
  std::array<std::vector<int>, 2> lists = {{{1, 2, 3}, {}}};
  Eigen::Vector3d vector = {1.0, std::numeric_limits<double>::denorm_min(), -3.0};
  Colour colour = Colour::green;
  bool flag = true;

  template <class A, class T>
  static void pass(A& archive, T& x) {
    archive(x.inners);
    archive(x.lists);
    archive(x.vector);
    archive(x.colour);
    archive(x.flag);
  }
};

constexpr std::uint64_t magic = 0x1234;

std::vector<unsigned char> written() {
  Writer w(magic);
  Content::pass(w, std::as_const(*std::make_unique<Content>()));
  return std::move(w).sealed();
}

TEST(Archive, ReadsWhatWasWritten) {
  const std::vector<unsigned char> bytes = written();
  Content c = {{}, {}, Eigen::Vector3d::Zero(), Colour::red, false};
  Reader r(bytes, magic);
  Content::pass(r, c);
  EXPECT_EQ(r.left(), 0U);
  ASSERT_EQ(c.inners.size(), 2U);
  EXPECT_EQ(c.inners[0].number, 1.5);
  EXPECT_EQ(c.inners[0].text, "one");
  EXPECT_TRUE(std::signbit(c.inners[1].number));
  EXPECT_EQ(c.lists[0], (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(c.lists[1].empty());
  EXPECT_EQ(c.vector, Content{}.vector);
  EXPECT_EQ(c.colour, Colour::green);
  EXPECT_TRUE(c.flag);
}

TEST(Archive, AnyDamageIsSeen) {
  const std::vector<unsigned char> bytes = written();
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::vector<unsigned char> damaged = bytes;
    damaged[k] ^= 0x10U;
    EXPECT_THROW(Reader(damaged, magic), ArchiveError) << k;
    EXPECT_THROW(Reader(Bytes(bytes).first(k), magic), ArchiveError) << k;
  }
  EXPECT_THROW(Reader(bytes, magic + 1), ArchiveError);
}

/// With a valid seal: reading more than there is, and a length that no content could have.
TEST(Archive, NothingIsReadBeyondTheEnd) {
  Writer w(magic);
  w(std::uint64_t{1} << 60);
  const std::vector<unsigned char> bytes = std::move(w).sealed();
  std::vector<double> values;
  Reader r(bytes, magic);
  EXPECT_THROW(r(values), ArchiveError);
  Reader again(bytes, magic);
  std::uint64_t number = 0;
  again(number);
  EXPECT_THROW(again(number), ArchiveError);
}

/// Of the reference implementation (Fowler, Noll, Vo).
TEST(Archive, HashIsFnv1a) {
  EXPECT_EQ(fnv1a(bytes_of("")), 0xcbf29ce484222325ULL);
  EXPECT_EQ(fnv1a(bytes_of("a")), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(fnv1a(bytes_of("foobar")), 0x85944171f73967e8ULL);
}

}  // namespace
}  // namespace fpz::sph::test
