#include <vector>

#include <gyrostat/recordings/matlab.hpp>
#include <gyrostat/recordings/write_columns.hpp>
#include <gyrostat/tests/fuzz/recorded.hpp>
#include <gyrostat/tests/fuzz/target.hpp>
#include <gyrostat/tests/program.hpp>

namespace gyrostat::fuzz {
namespace {

std::string seed_of_matlab() {
  const TestFolder folder;
  std::vector<double> t_s, gyro_dps;
  for (int k = 0; k < 40; ++k) {
    t_s.push_back(0.1 * k);
    gyro_dps.push_back(0.01 * (k * k % 7));
  }
  const std::vector<CsvColumn> columns = {{"t_s", t_s, {}}, {"gyro_z_dps", gyro_dps, {}}};
  write_mat(folder.path() / "rec.mat", columns);
  return folder.read("rec.mat");
}

}  // namespace

Target target_matlab() {
  return {.file = "rec.mat",
          .seeds = {seed_of_matlab()},
          .read = [](const std::filesystem::path& path) { read_z(path); }};
}

}  // namespace gyrostat::fuzz
