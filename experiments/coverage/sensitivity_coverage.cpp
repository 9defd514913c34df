#include <gyrostat/experiments/coverage/sensitivity_coverage.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/sensitivity/surrogate.hpp>
#include <gyrostat/analysis/sensitivity/test_functions.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

using Function = std::function<double(std::span<const double>)>;

/// Trial noise, in standard deviations of the function over the cube.
struct TrialNoise {
  std::string name;
  double own = 0.0;      ///< of each point
  double shared = 0.0;   ///< of all points together, in part as a factor on the output
  double failing = 0.0;  ///< share of trials without a value
};

struct Case {
  std::string function;
  Function f;
  double spread;  ///< standard deviation of the function
  std::size_t trials;
  TrialNoise noise;
};

/// y = f (1 + shared a_t) + spread (shared b_t + own e_it), with a, b, e standard normal.
Outputs simulate(const Case& c, const Points& points, std::uint64_t seed, std::uint32_t repeat) {
  Outputs outputs(points.size(), c.trials);
  std::vector<double> factors(c.trials), shifts(c.trials), own(c.trials);
  NormalStream(seed, repeat, "factors").fill(0, factors);
  NormalStream(seed, repeat, "shifts").fill(0, shifts);
  const NormalStream noise(seed, repeat, "own"), failures(seed, repeat, "failures");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double f = c.f(points[i]);
    noise.fill(i * c.trials, own);
    for (std::size_t t = 0; t < c.trials; ++t) {
      const bool fails =
          c.noise.failing > 0.0 && failures.uniform(i * c.trials + t) < c.noise.failing;
      outputs.at(i, t) = fails ? no_value
                               : f * (1.0 + 0.5 * c.noise.shared * factors[t]) +
                                     c.spread * (c.noise.shared * shifts[t] + c.noise.own * own[t]);
    }
  }
  return outputs;
}

/// An interval that is asked, again and again, whether it holds the truth.
struct Tally {
  std::string quantity;
  double truth;
  std::uint32_t made = 0, held = 0, below = 0;
  double sum = 0.0, width = 0.0;

  void add(const Estimate& e) {
    if (std::isnan(e.low) || std::isnan(e.high)) return;
    ++made;
    held += e.low <= truth && truth <= e.high;
    below += truth < e.low;
    sum += e.value;
    width += e.high - e.low;
  }
};

/// `measure` gives the estimates of one repeat, in the order of `tallies`.
void repeat(std::vector<Tally>& tallies, std::uint32_t repeats,
            const std::function<std::vector<Estimate>(std::uint32_t)>& measure) {
  std::vector<std::vector<Estimate>> estimates(repeats);
  tbb::parallel_for(0U, repeats, [&](std::uint32_t r) { estimates[r] = measure(r); });
  for (const auto& of_one : estimates)
    for (std::size_t q = 0; q < tallies.size(); ++q) tallies[q].add(of_one[q]);
}

void add_rows(Table& table, const std::string& design, const Case& c, std::uint32_t repeats,
              const std::vector<Tally>& tallies) {
  for (const auto& t : tallies) {
    const double share = static_cast<double>(t.held) / t.made;
    table.rows.push_back(
        {design, c.function, c.noise.name, static_cast<std::int64_t>(c.trials), t.quantity, t.truth,
         t.sum / t.made, 100.0 * share, 100.0 * std::sqrt(share * (1.0 - share) / t.made),
         100.0 * t.below / t.made, t.width / t.made, static_cast<std::int64_t>(repeats - t.made)});
  }
}

std::vector<Tally> named(const char* format, const std::vector<double>& truths) {
  std::vector<Tally> tallies;
  for (std::size_t i = 0; i < truths.size(); ++i)
    tallies.push_back({fmt::format(fmt::runtime(format), i + 1), truths[i]});
  return tallies;
}

/// Sobol' indices by rows alone, or with a surrogate.
void sobol(Table& table, const Case& c, const TrueIndices& truth, std::size_t rows,
           bool with_surrogate, std::uint32_t repeats, std::uint64_t seed) {
  const std::size_t parameters = truth.total.size();
  auto tallies = named("S_{}", truth.first_order);
  for (auto& tally : named("T_{}", truth.total)) tallies.push_back(tally);
  repeat(tallies, repeats, [&](std::uint32_t r) {
    const auto points = saltelli_rows(rows, parameters, {seed + r, "coverage"});
    Resampler resampler(seed + r, "coverage");
    const auto outputs = simulate(c, points, seed, r);
    const auto indices =
        with_surrogate
            ? surrogate_of(points, std::vector<std::size_t>(parameters, 0), outputs, resampler)
                  .indices
            : sobol_indices(parameters, outputs, resampler);
    std::vector<Estimate> estimates;
    for (std::size_t p = 0; p < parameters; ++p) estimates.push_back(indices[p].first_order);
    for (std::size_t p = 0; p < parameters; ++p) estimates.push_back(indices[p].total);
    return estimates;
  });
  add_rows(table, fmt::format("{}, {} rows", with_surrogate ? "surrogate" : "saltelli", rows), c,
           repeats, tallies);
}

/// mu* and sigma over all steps of the grid, by going through them.
std::pair<double, double> true_effects(const Case& c, std::size_t parameters, std::size_t levels,
                                       std::size_t p) {
  const double step = morris_step(levels), last = static_cast<double>(levels - 1);
  double size = 0.0, sum = 0.0, squares = 0.0, count = 0.0;
  std::vector<std::size_t> at(parameters, 0);
  for (;;) {
    if (at[p] < levels / 2) {
      std::vector<double> x(parameters);
      for (std::size_t i = 0; i < parameters; ++i) x[i] = static_cast<double>(at[i]) / last;
      const double before = c.f(x);
      x[p] += step;
      const double effect = (c.f(x) - before) / step;
      size += std::abs(effect);
      sum += effect;
      squares += effect * effect;
      count += 1.0;
    }
    std::size_t i = 0;
    while (i < parameters && ++at[i] == levels) at[i++] = 0;
    if (i == parameters) break;
  }
  return {size / count, std::sqrt(squares / count - sum * sum / count / count)};
}

void morris(Table& table, const Case& c, std::size_t parameters, std::size_t trajectories,
            std::size_t levels, std::uint32_t repeats, std::uint64_t seed) {
  std::vector<double> sizes, spreads;
  for (std::size_t p = 0; p < parameters; ++p) {
    const auto [size, spread] = true_effects(c, parameters, levels, p);
    sizes.push_back(size);
    spreads.push_back(spread);
  }
  auto tallies = named("mu*_{}", sizes);
  for (auto& tally : named("sigma_{}", spreads)) tallies.push_back(tally);
  repeat(tallies, repeats, [&](std::uint32_t r) {
    const auto points =
        morris_trajectories(trajectories, levels, parameters, {seed + r, "coverage"});
    Resampler resampler(seed + r, "coverage");
    const auto effects =
        elementary_effects(points, simulate(c, points, seed, r), morris_step(levels), resampler);
    std::vector<Estimate> estimates;
    for (const auto& effect : effects) estimates.push_back(effect.mu_star);
    for (const auto& effect : effects) estimates.push_back(effect.sigma);
    return estimates;
  });
  add_rows(table, fmt::format("morris, {} trajectories, {} levels", trajectories, levels), c,
           repeats, tallies);
}

/// Around the middle of [1, 2]^3, of x1 x2^2 + x3.
void one_at_a_time_case(Table& table, const Case& c, std::uint32_t repeats, std::uint64_t seed) {
  const std::vector<Excursion> excursions(3, Excursion{1.5, 1.0, 2.0});
  const auto points = one_at_a_time({0.5, 0.5, 0.5});
  std::vector<double> truths;
  for (std::size_t p = 0; p < 3; ++p)
    truths.push_back((c.f(points[2 + 2 * p]) - c.f(points[1 + 2 * p])) * 1.5 / c.f(points[0]));
  auto tallies = named("elasticity_{}", truths);
  repeat(tallies, repeats, [&](std::uint32_t r) {
    Resampler resampler(seed + r, "coverage");
    std::vector<Estimate> estimates;
    for (const auto& e : elasticities(simulate(c, points, seed, r), excursions, resampler))
      estimates.push_back(e.value);
    return estimates;
  });
  add_rows(table, "one_at_a_time", c, repeats, tallies);
}

std::string kind_of(const std::string& design, const std::string& quantity) {
  if (design.starts_with("surrogate")) return "Sobol' indices, surrogate";
  if (quantity.starts_with("elasticity")) return "elasticities";
  if (quantity.starts_with("sigma")) return "σ";
  return quantity.starts_with("mu*") ? "μ*" : "Sobol' indices";
}

/// In the order of their first rows.
Table groups_of(const Table& intervals) {
  struct Group {
    std::string kind, noise;
    std::vector<double> coverages;
  };
  std::vector<Group> groups;
  for (const auto& row : intervals.rows) {
    const auto kind = kind_of(std::get<std::string>(row[0]), std::get<std::string>(row[4]));
    const auto& noise = std::get<std::string>(row[2]);
    auto at = std::find_if(groups.begin(), groups.end(),
                           [&](const Group& g) { return g.kind == kind && g.noise == noise; });
    if (at == groups.end()) at = groups.insert(at, {kind, noise, {}});
    at->coverages.push_back(std::get<double>(row[7]));
  }
  Table table{.title = "Coverage by kind of interval",
              .columns = {{"intervals of", ""},
                          {"trial noise", ""},
                          {"how many", ""},
                          {"smallest", "%"},
                          {"mean", "%"},
                          {"largest", "%"}}};
  for (const auto& [kind, noise, of] : groups) {
    const auto [low, high] = std::minmax_element(of.begin(), of.end());
    const auto count = static_cast<double>(of.size());
    table.rows.push_back({kind, noise, static_cast<std::int64_t>(of.size()), *low,
                          std::accumulate(of.begin(), of.end(), 0.0) / count, *high});
  }
  return table;
}

double polynomial(std::span<const double> u) {
  return (1.0 + u[0]) * (1.0 + u[1]) * (1.0 + u[1]) + 1.0 + u[2];
}

}  // namespace

std::vector<NamedTable> sensitivity_coverage(std::uint32_t repeats, std::uint64_t seed) {
  Table table{.title = fmt::format("Coverage of nominal 95 % intervals, {} repeats", repeats),
              .columns = {{"design", ""},
                          {"function", ""},
                          {"noise", ""},
                          {"trials", ""},
                          {"quantity", ""},
                          {"truth", ""},
                          {"mean estimate", ""},
                          {"coverage", "%"},
                          {"standard error", "%"},
                          {"truth below", "%"},
                          {"mean width", ""},
                          {"no interval", "repeats"}}};
  const std::vector<double> a = {0.0, 1.0, 4.5, 9.0};
  const Function g = [a](std::span<const double> u) { return sobol_g(u, a); };
  const std::vector<TrialNoise> noises = {{"none", 0.0, 0.0, 0.0},
                                          {"own", 1.0, 0.0, 0.0},
                                          {"shared", 0.3, 0.5, 0.0},
                                          {"own, 5 % fail", 1.0, 0.0, 0.05},
                                          {"own, heavy", 4.0, 0.0, 0.0}};
  std::uint64_t next = seed << 32U;  // so that no two designs share their random numbers
  const auto fresh = [&] { return next += repeats; };
  for (const auto& noise : noises) {
    const Case ishi{"Ishigami", ishigami, 3.72, 20, noise};
    sobol(table, ishi, ishigami_indices(), 128, false, repeats, fresh());
    sobol(table, ishi, ishigami_indices(), 512, false, repeats, fresh());
    const Case product{"Sobol' g", g, 0.75, 20, noise};
    sobol(table, product, sobol_g_indices(a), 256, false, repeats, fresh());
    morris(table, product, 4, 20, 4, repeats, fresh());
    morris(table, product, 4, 50, 8, repeats, fresh());
    morris(table, ishi, 3, 50, 8, repeats, fresh());
    if (noise.own > 0.0) {
      one_at_a_time_case(table, {"x1 x2^2 + x3", polynomial, 1.0, 20, noise}, repeats, fresh());
      one_at_a_time_case(table, {"x1 x2^2 + x3", polynomial, 1.0, 200, noise}, repeats, fresh());
    }
  }
  for (const auto& noise : noises) {
    sobol(table, {"Ishigami", ishigami, 3.72, 20, noise}, ishigami_indices(), 51, true, repeats,
          fresh());
    sobol(table, {"Sobol' g", g, 0.75, 20, noise}, sobol_g_indices(a), 51, true, repeats, fresh());
  }
  table.notes.push_back(
      "standard error: of the coverage, binomial; truth below: share of intervals that lie "
      "wholly above the truth, 2.5 % for equal tails");
  return {{"intervals", table}, {"groups", groups_of(table)}};
}

}  // namespace gyrostat
