// What does my recording have that the simulator has not?
#include <cstdio>
#include <exception>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/diagnosis_tables.hpp>
#include <gyrostat/recordings/recording.hpp>

int main(int argc, char** argv) try {
  using namespace gyrostat;
  if (argc != 2) return std::puts("usage: diagnose_recording REC.csv"), 2;

  const Recording recording = read_recording(argv[1]);
  const gap::Diagnosis diagnosis = gap::diagnose(recording.series, {});
  std::fputs(gap::in_words(diagnosis, argv[1]).c_str(), stdout);

  for (const auto& cause : diagnosis.causes)
    std::printf("  %-20s probability %.2f, closes %.0f %% of the gap\n", cause.effect.c_str(),
                cause.probability, 100.0 * cause.closed);
  return 0;
} catch (const std::exception& failure) {
  return std::fprintf(stderr, "%s\n", failure.what()), 1;
}
