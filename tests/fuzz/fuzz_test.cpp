// What fuzzers feed on is read without an error, and what they once found is refused in words.

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>

#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/places.hpp>

namespace gyrostat::fuzz_test {
namespace {

TEST(Fuzz, EverySeedIsRead) {
  for (const auto& [name, target] : fuzz::targets()) {
    const fuzz::Reader reader(target);
    EXPECT_FALSE(target.seeds.empty()) << name;
    for (std::size_t k = 0; k < target.seeds.size(); ++k)
      EXPECT_EQ(reader.refusal(target.seeds[k]), "") << name << ' ' << k;
  }
}

TEST(Fuzz, AShortenedSeedEndsInWordsOrIsRead) {
  for (const auto& [name, target] : fuzz::targets()) {
    const fuzz::Reader reader(target);
    const auto& seed = target.seeds.front();
    std::size_t refused = 0;
    for (std::size_t k = 0; k < 16; ++k)
      refused += !reader.refusal(seed.substr(0, seed.size() * k / 16)).empty();
    EXPECT_GT(refused, 0u) << name;
  }
}

/// found/<target>/<fault>: documents on which a target once ended otherwise.
TEST(Fuzz, WhatWasFoundOnceIsAnsweredInWords) {
  namespace fs = std::filesystem;
  std::size_t documents = 0;
  for (const auto& folder :
       fs::directory_iterator(fs::path(places::source()) / "tests/fuzz/found")) {
    const fuzz::Reader reader(fuzz::targets().at(folder.path().filename().string()));
    for (const auto& entry : fs::directory_iterator(folder)) {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string document{std::istreambuf_iterator<char>(file), {}};
      EXPECT_NO_THROW(reader.refusal(document)) << entry.path();
      ++documents;
    }
  }
  EXPECT_GT(documents, 0u);
}

}  // namespace
}  // namespace gyrostat::fuzz_test
