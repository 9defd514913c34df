// A filter of our own, in a study beside those of gyrostat.
#include <cstdio>
#include <exception>

#include <gyrostat/experiments/findings/ranking.hpp>
#include <gyrostat/experiments/run/runner.hpp>
#include <gyrostat/results/render/render.hpp>

#include "leaky_mean.hpp"

int main(int argc, char** argv) try {
  using namespace gyrostat;
  filter_types().add(describe_filter<own::LeakyMean>("leaky_mean"));  // from here on it has a name

  const Study study = read_study(argc > 1 ? argv[1] : "study.json");
  for (const Cell& cell : study.cells) {
    const CellResult result = run_cell(cell, study.seed, {});
    const Table table = ranking_table(rank_cell(cell, result));
    std::fputs(render({&table, 1}, Format::text).c_str(), stdout);
  }
  return 0;
} catch (const std::exception& failure) {
  return std::fprintf(stderr, "%s\n", failure.what()), 1;
}
