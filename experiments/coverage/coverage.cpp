#include <gyrostat/experiments/coverage/coverage.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/experiments/run/study_store.hpp>
#include <gyrostat/experiments/study/json_object.hpp>

namespace gyrostat {
namespace {

constexpr double nominal = 0.95, tolerance = 0.02;
constexpr Range sample_range{.from = 2, .to = 1e7, .whole = true};

std::uint32_t count(JsonObject& object, const char* key, double fallback) {
  return static_cast<std::uint32_t>(object.number(key, fallback, sample_range, ""));
}

std::string verdict(double low, double high) {
  if (low >= nominal - tolerance && high <= nominal + tolerance) return "within 93–97 %";
  if (low < nominal - tolerance) return "too narrow";
  return "too wide";
}

coverage_detail::Population population_of(const Cell& cell, const CellResult& result) {
  coverage_detail::Population population{cell, {}};
  for (std::uint32_t t = 0; t < result.trials.size(); ++t)
    if (result.trials[t]) population.trials.push_back(row_of(0, t, *result.trials[t]).outcomes);
  return population;
}

/// A run that was shortened draws as many samples less.
CoverageStudy in_proportion(CoverageStudy study, std::size_t population) {
  const double share = static_cast<double>(population) / study.population;
  for (auto* number : {&study.samples, &study.fits})
    *number = std::max(2U, static_cast<std::uint32_t>(share * *number));
  return study;
}

}  // namespace

Coverage::Count& Coverage::count_of(const std::string& name) {
  const auto found =
      std::find_if(counts.begin(), counts.end(), [&](const Count& c) { return c.name == name; });
  return found != counts.end() ? *found : counts.emplace_back(Count{.name = name});
}

void Coverage::add(const std::string& name, double low, double truth, double high) {
  auto& count = count_of(name);
  if (std::isnan(truth) || std::isnan(low) || std::isnan(high)) {
    ++count.none;
    return;
  }
  ++count.intervals;
  count.hits += low <= truth && truth <= high;
}

void Coverage::add(const std::string& name, bool holds) {
  auto& count = count_of(name);
  ++count.intervals;
  count.hits += holds;
}

CoverageStudy read_coverage(const std::string& path) {
  const Json json = read_json(path);
  JsonObject object(json, path + ":");
  CoverageStudy study;
  study.title = object.text("title", std::filesystem::path(path).stem().string());
  const auto beside = [&](const std::string& file) {
    return (std::filesystem::path(path).parent_path() / file).lexically_normal().string();
  };
  study.study = beside(object.required_text("study"));
  study.signals = beside(object.required_text("signals"));
  study.population = count(object, "population", study.population);
  study.samples = count(object, "samples", study.samples);
  study.fits = count(object, "fits", study.fits);
  study.seed = static_cast<std::uint64_t>(
      object.number("seed", 1, {.from = 0, .to = 9e15, .whole = true}, ""));
  const auto counts = [&](const char* key, std::vector<std::uint32_t>& list) {
    for (const auto& [value, place] : object.list(key))
      list.push_back(static_cast<std::uint32_t>(
          JsonObject::checked_number(*value, place, sample_range, "trials")));
    if (list.empty()) throw InputError(object.place_of(key), "the list is missing or empty");
  };
  counts("sizes", study.sizes);
  counts("first_looks", study.first_looks);
  object.finish();
  return study;
}

std::vector<Coverage> measure_coverage(
    const CoverageStudy& wanted, const std::function<CellResult(const Study&, const Cell&)>& run) {
  const Study study = read_study(wanted.study), signals = read_study(wanted.signals);
  std::vector<Cell> cells = study.cells;
  std::vector<coverage_detail::Population> populations;
  populations.reserve(cells.size());
  CoverageStudy scaled = wanted;
  std::vector<std::function<std::vector<Coverage>()>> measurements;
  for (Cell& cell : cells) {
    cell.trials = wanted.population;
    const auto& population = populations.emplace_back(population_of(cell, run(study, cell)));
    scaled = in_proportion(wanted, population.trials.size());
    for (const auto size : wanted.sizes)
      measurements.push_back([&population, scaled, size] {
        return coverage_detail::of_samples(scaled, population, size);
      });
    for (const auto first : wanted.first_looks)
      measurements.push_back([&population, scaled, first] {
        return coverage_detail::of_stopped_samples(scaled, population, first);
      });
  }
  for (const auto& cell : signals.cells)
    measurements.push_back(
        [&signals, &cell, scaled] { return coverage_detail::of_signals(scaled, signals, cell); });

  std::vector<std::vector<Coverage>> found(measurements.size());
  tbb::parallel_for(std::size_t{0}, measurements.size(),
                    [&](std::size_t i) { found[i] = measurements[i](); });
  std::vector<Coverage> all;
  for (auto& some : found)
    for (auto& coverage : some)
      if (!coverage.counts.empty()) all.push_back(std::move(coverage));
  std::stable_sort(all.begin(), all.end(),
                   [](const Coverage& a, const Coverage& b) { return a.interval < b.interval; });
  return all;
}

Table coverage_table(const CoverageStudy& study, const std::vector<Coverage>& coverages) {
  Table table{.title = study.title,
              .columns = {{"interval", ""},
                          {"cell", ""},
                          {"n", ""},
                          {"of", ""},
                          {"lowest", "%"},
                          {"which", ""},
                          {"highest", "%"},
                          {"standard error", "%"},
                          {"no interval", "%"},
                          {"verdict", ""}}};
  for (const auto& coverage : coverages) {
    std::vector<Coverage::Count> counts;
    double none = 0.0, draws = 0.0;
    for (const auto& c : coverage.counts) {
      if (c.intervals > 0) counts.push_back(c);
      none += c.none;
      draws += c.none + c.intervals;
    }
    if (counts.empty()) continue;
    const auto [least, most] =
        std::minmax_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.share() < b.share(); });
    const double error = std::sqrt(nominal * (1.0 - nominal) / least->intervals);
    table.rows.push_back({coverage.interval, coverage.cell, std::int64_t{coverage.size},
                          static_cast<std::int64_t>(counts.size()), 100.0 * least->share(),
                          least->name, 100.0 * most->share(), 100.0 * error, 100.0 * none / draws,
                          verdict(least->share(), most->share())});
  }
  table.notes.push_back(
      fmt::format("shares of intervals that hold the truth, nominally 95 %; lowest and highest of "
                  "those that the interval "
                  "was made of (methods, metrics, parameters); populations of {} trials, {} "
                  "samples of each, {} signals",
                  study.population, study.samples, study.fits));
  return table;
}

namespace coverage_detail {

Draws::Draws(const CoverageStudy& study, const Population& population, std::uint32_t sample,
             const std::string& what)
    : population_(population), stream_(study.seed, sample, population.cell.name + "/" + what) {}

const std::vector<double>& Draws::operator()(std::uint64_t i) const {
  const double n = static_cast<double>(population_.trials.size());
  return population_.trials[static_cast<std::size_t>(stream_.uniform(i) * n)];
}

}  // namespace coverage_detail
}  // namespace gyrostat
