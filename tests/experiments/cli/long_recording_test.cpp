// Recordings of more than 2^22 samples, of which a diagnosis looks at parts.

#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <gyrostat/core/random.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::long_recording_test {
namespace {

using testing::HasSubstr;

constexpr std::size_t samples = 5'000'000;

/// A NumPy file of one float a sample, in dps.
template <class Value>
void write_npy(const TestFolder& folder, const Value& value) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (5000000,), }";
  header.resize(117, ' ');
  header += '\n';
  std::string file("\x93NUMPY\x01\x00\x76\x00", 10);
  file += header;
  const std::size_t begins = file.size();
  file.resize(begins + samples * sizeof(float));
  for (std::size_t i = 0; i < samples; ++i) {
    const auto z = static_cast<float>(value(i));
    std::memcpy(file.data() + begins + i * sizeof z, &z, sizeof z);
  }
  folder.write("long.npy", file);
}

Ended run_long(const TestFolder& folder, std::vector<std::string> words) {
  for (const char* word :
       {"long.npy", "--columns", "1=gyro", "--units", "gyro=dps", "--rate", "1000"})
    words.push_back(word);
  return run_program(folder, words);
}

/// White noise of 0.1 dps. The first variance is the mean of (z[i+1] - z[i])^2 / 2, whose own is 3
/// / N of its square: the deviation's standard error is 3.9e-4 of it. Five of them fail in one of
/// two million.
TEST(LongRecording, HasTheAllanDeviationOfItsNoise) {
  const TestFolder folder;
  const NormalStream noise(1, 0, "long_recording");
  write_npy(folder, [&](std::size_t i) { return 0.1 * noise.normal(i); });
  const auto ended = run_long(folder, {"allan", "--format", "json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto first = nlohmann::json::parse(ended.out).at(0).at("rows").at(0);
  EXPECT_EQ(first.at(0), 0.001);
  EXPECT_NEAR(first.at(1).get<double>(), 0.1, 5 * 3.9e-4 * 0.1);
}

TEST(LongRecording, WhoseGyroHangsHasNothingToDiagnose) {
  const TestFolder folder;
  write_npy(folder, [](std::size_t) { return 0.14; });
  const auto ended = run_long(folder, {"diagnose"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("362.856 to 887.143 s: the gyro never changes; left out"));
  EXPECT_THAT(ended.err, HasSubstr("long.npy: gyro_dps never changes; there is nothing"));
}

}  // namespace
}  // namespace gyrostat::long_recording_test
