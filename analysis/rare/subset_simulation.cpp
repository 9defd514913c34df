#include <gyrostat/analysis/rare/subset_simulation.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/analysis/statistics/running.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {
namespace {

constexpr double wanted_acceptance = 0.44;

}  // namespace

SubsetSimulation::SubsetSimulation(const SubsetPlan& plan, std::uint32_t first)
    : plan_(plan), first_(first) {
  assert(plan.samples * plan.share >= 1.0 && plan.most_levels > 0);
  for (std::uint32_t i = 0; i < plan.samples; ++i) asked_.push_back({first + i, 0, 1.0});
}

std::vector<NoiseShare> SubsetSimulation::shares(const SubsetMove& move) const {
  std::vector<NoiseShare> shares;
  double weight = 1.0;
  for (const auto* at = &move;; at = &moves_.at(at->parent)) {
    shares.push_back({at->trial, weight * at->spread});
    if (at->spread == 1.0) break;
    weight *= std::sqrt(1.0 - at->spread * at->spread);
  }
  std::reverse(shares.begin(), shares.end());
  return shares;
}

void SubsetSimulation::tell(std::span<const double> values) {
  assert(values.size() == asked_.size());
  trials_ += static_cast<std::uint32_t>(values.size());
  std::uint32_t taken = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    assert(!std::isnan(values[i]));
    moves_.emplace(asked_[i].trial, asked_[i]);
    if (levels_.empty()) {
      samples_.push_back({asked_[i].trial, values[i]});
    } else {
      if (values[i] > above_) {
        chains_[i] = {asked_[i].trial, values[i]};
        ++taken;
      }
      samples_.push_back(chains_[i]);
    }
  }
  if (!levels_.empty()) {
    ++links_;
    accepted_ += taken;
    moved_ += static_cast<std::uint32_t>(values.size());
    const double rate = static_cast<double>(taken) / static_cast<double>(values.size());
    spread_ = std::min(1.0, spread_ * std::exp((rate - wanted_acceptance) / std::sqrt(links_)));
  }
  if (samples_.size() < plan_.samples)
    ask();
  else
    end_level();
}

/// The next link of every chain, or of as many as the level still has room for.
void SubsetSimulation::ask() {
  asked_.clear();
  const auto level = static_cast<std::uint32_t>(levels_.size());
  const std::size_t count = std::min(chains_.size(), plan_.samples - samples_.size());
  for (std::size_t c = 0; c < count; ++c)
    asked_.push_back(
        {first_ + level * plan_.samples + static_cast<std::uint32_t>(samples_.size() + c),
         chains_[c].trial, std::min(spread_, 1.0 - 0x1p-20)});
}

void SubsetSimulation::end_level() {
  asked_.clear();
  auto sorted = samples_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const State& a, const State& b) { return a.value > b.value; });
  const auto beyond = [&](double threshold) {
    return static_cast<std::size_t>(
        std::find_if(sorted.begin(), sorted.end(),
                     [&](const State& s) { return !(s.value > threshold); }) -
        sorted.begin());
  };
  const double count = plan_.samples;
  const auto wanted = static_cast<std::size_t>(plan_.share * count);
  double threshold = sorted[wanted].value;
  // Where more than that are the highest, what is next below them.
  if (beyond(threshold) == 0)
    for (const auto& s : sorted)
      if (s.value < threshold) {
        threshold = s.value;
        break;
      }
  const bool last = threshold >= plan_.threshold;
  if (last) threshold = plan_.threshold;
  const std::size_t above = beyond(threshold);
  levels_.push_back({threshold, static_cast<double>(above) / count,
                     moved_ == 0 ? 1.0 : static_cast<double>(accepted_) / moved_,
                     levels_.empty() ? 1.0 : spread_,
                     static_cast<std::uint32_t>(levels_.empty() ? 0 : chains_.size())});
  sorted.resize(above);
  reached_ = last;
  if (last)
    for (const auto& s : sorted) failing_.push_back(s.trial);
  else if (above > 0 && levels_.size() < plan_.most_levels)
    begin_level(std::move(sorted));
}

void SubsetSimulation::begin_level(std::vector<State> seeds) {
  // By their numbers, so that the first links are of no particular seeds.
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const State& a, const State& b) { return a.trial < b.trial; });
  above_ = levels_.back().threshold;
  chains_ = seeds;
  samples_ = std::move(seeds);
  links_ = accepted_ = moved_ = 0;
  if (samples_.size() < plan_.samples)
    ask();
  else
    end_level();
}

double SubsetSimulation::probability() const {
  if (!reached_) return 0.0;
  double product = 1.0;
  for (const auto& level : levels_) product *= level.share;
  return product;
}

double SubsetSimulation::bound() const {
  double product = 1.0;
  for (const auto& level : levels_)
    if (level.share > 0.0) product *= level.share;
  return product;
}

double RareProbability::reliability_index() const {
  const bool is_certain = probability <= 0.0 || probability >= 1.0;
  return is_certain ? no_value : normal_upper_quantile(probability);
}

double RareProbability::plain_trials() const {
  return (1.0 - probability) / (probability * variation * variation);
}

RareProbability rare_probability(std::span<const double> runs) {
  assert(runs.size() > 1);
  Running values, logs;
  for (const double p : runs) {
    values.add(p);
    logs.add(std::log(p));
  }
  const double n = static_cast<double>(runs.size()), s2 = logs.squares / (n - 1.0);
  const double centre = logs.mean + 0.5 * s2;
  const double reach =
      student_t_two_sided(0.95, n - 1.0) * std::sqrt(s2 / n + s2 * s2 / (2.0 * (n - 1.0)));
  return {values.mean, std::min(values.mean, std::exp(centre - reach)),
          std::clamp(std::exp(centre + reach), values.mean, 1.0), values.error() / values.mean};
}

double rarer_than(std::span<const double> bounds) { return rare_probability(bounds).high; }

void complete(SubsetSimulation& run, std::uint64_t seed, std::size_t dimension,
              const std::function<double(std::span<const double>)>& function) {
  std::vector<double> z(dimension), values;
  while (!run.asked().empty()) {
    values.clear();
    for (const auto& move : run.asked()) {
      const auto shares = run.shares(move);
      NormalStream(seed, move.trial, "z", shares, nullptr).fill(0, z);
      values.push_back(function(z));
    }
    run.tell(values);
  }
}

}  // namespace gyrostat
