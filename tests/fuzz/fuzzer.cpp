// The program that libFuzzer drives:
//   gyrostat_fuzz --list             names of targets
//   gyrostat_fuzz --seeds FOLDER     the seeds of each in a folder of its own
//   gyrostat_fuzz TARGET …           libFuzzer on that target, with its own arguments

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gyrostat/tests/fuzz/target.hpp>

using gyrostat::fuzz::targets;

namespace {

std::unique_ptr<gyrostat::fuzz::Reader> reader;

void write_seeds(const std::filesystem::path& folder) {
  for (const auto& [name, target] : targets()) {
    std::filesystem::create_directories(folder / name);
    for (std::size_t k = 0; k < target.seeds.size(); ++k)
      std::ofstream(folder / name / ("seed_" + std::to_string(k)), std::ios::binary)
          << target.seeds[k];
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string first = *argc > 1 ? (*argv)[1] : "";
  if (first == "--seeds" && *argc > 2) {
    write_seeds((*argv)[2]);
    std::exit(0);
  }
  const auto chosen = targets().find(first);
  if (chosen == targets().end()) {
    for (const auto& [name, unused] : targets()) std::puts(name.c_str());
    std::exit(first == "--list" ? 0 : 2);
  }
  reader = std::make_unique<gyrostat::fuzz::Reader>(chosen->second);
  for (int i = 1; i + 1 < *argc; ++i) (*argv)[i] = (*argv)[i + 1];
  --*argc;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reader->refusal({reinterpret_cast<const char*>(data), size});
  return 0;
}
