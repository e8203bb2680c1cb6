#include "fpz/driver/history.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "fpz/io/csv.hpp"
#include "fpz/io/output.hpp"
#include "helpers.hpp"

namespace fpz::driver {
namespace {

TEST(HistoryFile, HasTheDocumentedColumns) {
  const std::string csv = to_csv({});
  EXPECT_EQ(
      csv,
      "stage,increment,time,eps_xx,eps_yy,eps_zz,eps_xy,eps_xz,eps_yz,sig_xx,sig_yy,sig_zz,sig_xy,sig_xz,sig_yz,"
      "cracked,n_x,n_y,"
      "n_z,u_n,u_s1,u_s2,up_n,up_s,t_n,t_s1,t_s2,D,energy_stored,energy_dissipated,iterations,status,energy_work\n");
}

TEST(HistoryFile, NumbersSurviveTheRoundTrip) {
  const Result result = run_test(four_stages(100));
  const io::Table table = io::parse_csv(to_csv(result.history), "history");
  ASSERT_EQ(table.rows(), result.history.size());
  for (const Column& c : columns()) {
    if (!c.get) continue;
    for (std::size_t i = 0; i < table.rows(); ++i) EXPECT_EQ(table.at(c.name)[i], c.get(result.history[i])) << c.name;
  }
}

TEST(HistoryFile, BeginsWithTheInitialState) {
  const Result result = run_test(four_stages(100));
  const Row& first = result.history.front();
  EXPECT_EQ(first.stage, 0);
  EXPECT_EQ(first.time, 0.0);
  EXPECT_FALSE(first.cracked);
  EXPECT_EQ(first.stress[0], 0.0);
}

TEST(Csv, SaysWhatIsWrong) {
  EXPECT_THROW((void)io::parse_csv("a,b\n1\n", "x"), InputError);
  EXPECT_THROW((void)io::parse_csv("a,b\n", "x"), InputError);
  EXPECT_THROW((void)io::read_csv("/nowhere/x.csv"), InputError);
  try {
    (void)io::parse_csv("a,b\n1,2\n", "x.csv").at("c");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("\"c\""), std::string::npos);
  }
}

TEST(Output, ReplacesNothingUnlessForced) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.txt";
  io::write_text(file, "one", false);
  EXPECT_THROW(io::write_text(file, "two", false), io::OutputError);
  std::string text;
  std::getline(std::ifstream(file), text);
  EXPECT_EQ(text, "one");
  io::write_text(file, "two", true);
  std::getline(std::ifstream(file), text);
  EXPECT_EQ(text, "two");
}

TEST(Output, AFailedWriteLeavesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.txt";
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw io::OutputError("disk full");
  };
  EXPECT_THROW(io::replace_file(file, false, fail), io::OutputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(io::make_writable_folder("/proc/nowhere"), io::OutputError);
}

}  // namespace
}  // namespace fpz::driver
