// The fuzz target without a fuzzer: its corpus and deterministic mutations of it, so that every compiler covers it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "path_file_fuzz.hpp"

namespace {

std::vector<std::string> corpus() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {FPZ_SOURCE_DIR "/tests/fuzz/corpus", FPZ_DATA_DIR "/paths"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

void feed(const std::string& text) {
  fpz::driver::read_as_path_file(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

/// Fragments that take a mutation somewhere: brackets, extreme numbers, keys out of place.
const std::vector<std::string>& tokens() {
  static const std::vector<std::string> list = {"{",          "}",          "[",          "]",     ",",
                                                ":",          "\"",         "null",       "-1",    "1e308",
                                                "1e999",      "NaN",        "1e-400",     "0",     "\\u0000",
                                                "\"repeat\"", "\"stages\"", "\"tests\"",  "\"D\"", "\"material\"",
                                                "\"3d\"",     "\"zz\"",     "\"stress\"", "//",    "\xff",
                                                "\n"};
  return list;
}

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t changes = 1 + below(4);
  for (std::size_t k = 0; k < changes; ++k) {
    if (text.empty()) text = "{}";
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(std::min<std::size_t>(text.size() - at, 30));
    switch (below(5)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      case 3:
        text.insert(at, tokens()[below(tokens().size())]);
        break;
      default:
        text.replace(at, length, tokens()[below(tokens().size())]);
        break;
    }
  }
  return text;
}

TEST(PathFileFuzz, Corpus) {
  const std::vector<std::string> texts = corpus();
  EXPECT_GE(texts.size(), 15u);
  for (const std::string& text : texts) feed(text);
}

TEST(PathFileFuzz, Mutations) {
  const std::vector<std::string> texts = corpus();
  ASSERT_FALSE(texts.empty());
  std::mt19937 random(20200713);  // its sequence is fixed by the standard
  for (int k = 0; k < 6000; ++k) {
    std::string text = mutated(texts[static_cast<std::size_t>(k) % texts.size()], random);
    SCOPED_TRACE(text);
    feed(text);
  }
}

TEST(PathFileFuzz, TruncationsOfASmallFile) {
  const std::vector<std::string> texts = corpus();
  const auto shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
  std::vector<std::string> sorted = texts;
  std::sort(sorted.begin(), sorted.end(), shorter);
  for (std::size_t k = 0; k < std::min<std::size_t>(sorted.size(), 5); ++k) {
    for (std::size_t n = 0; n < sorted[k].size(); ++n) feed(sorted[k].substr(0, n));
  }
}

}  // namespace
