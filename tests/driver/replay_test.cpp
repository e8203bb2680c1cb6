#include "fpz/driver/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "fpz/capture.hpp"
#include "fpz/update.hpp"
#include "helpers.hpp"

namespace fpz::driver {
namespace {

using testing::HasSubstr;

/// A point past onset, about to be strained.
template <int Dim>
Capture<Dim> cracked_capture(Setting setting) {
  Capture<Dim> c;
  c.parameters = test::table1();
  c.setting = setting;
  Tensor<double, Dim> d = Tensor<double, Dim>::Zero();
  d[0] = 2e-3;
  EXPECT_TRUE(update<Dim>(make_material(c.parameters, setting), c.options, c.begin, d, c.begin).ok());
  c.strain_increment[1] = 1e-5;
  return c;
}

TEST(Replay, RepeatsACapturedUpdate) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  ASSERT_TRUE(write_capture<2>(file, cracked_capture<2>(Setting::plane_strain)));
  const Replay two = replay(file);
  EXPECT_TRUE(two.ok());
  EXPECT_EQ(two.captured, Status::ok);
  EXPECT_THAT(two.text, HasSubstr("as captured"));
  EXPECT_THAT(two.text, HasSubstr("\"implicit\""));
  ASSERT_TRUE(write_capture<3>(file, cracked_capture<3>(Setting::three_d)));
  EXPECT_TRUE(replay(file).ok());
}

TEST(Replay, AFailureFailsAgain) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  Capture<2> c = cracked_capture<2>(Setting::plane_strain);
  c.strain_increment[0] = std::nan("");
  c.status = Status::invalid_input;
  ASSERT_TRUE(write_capture<2>(file, c));
  const Replay r = replay(file);
  EXPECT_EQ(r.now, Status::invalid_input);
  EXPECT_EQ(r.captured, Status::invalid_input);
}

TEST(Replay, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "capture.json";
  const auto message = [&](const std::string& text) {
    std::ofstream(file) << text;
    try {
      (void)replay(file);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("{"), HasSubstr("not JSON"));
  EXPECT_THAT(message("[]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(message(R"({"fpz_capture": 1})"), HasSubstr("\"setting\" is missing"));
  EXPECT_THAT(message(R"({"fpz_capture": 1, "setting": "4d"})"), HasSubstr("\"4d\" is none of"));
}

}  // namespace
}  // namespace fpz::driver
