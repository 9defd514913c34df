#include <gyrostat/analysis/search/staged_search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gyrostat/analysis/search/quadratic_surrogate.hpp>
#include <gyrostat/analysis/sensitivity/designs.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t finalists = 4, fewest_candidates = 8, most_candidates = 4096;
constexpr int rounds = 3;
constexpr double first_radius = 0.25;
constexpr double worst = std::numeric_limits<double>::infinity();

struct TriedPoint {
  std::vector<double> point;   ///< in the unit cube
  std::vector<double> values;  ///< in the box
  std::vector<double> numbers{};
};

class StagedSearch {
 public:
  StagedSearch(const std::vector<SearchRange>& ranges, const StagedSearchPlan& plan,
               const CandidateTrials& run,
               const std::function<double(std::span<const double>)>& objective)
      : ranges_(ranges), plan_(plan), run_(run), objective_(objective) {}

  StagedSearchResult search(const std::vector<double>& start) {
    TriedPoint first{.point = {}, .values = start};
    for (std::size_t i = 0; i < start.size(); ++i)
      first.point.push_back(fraction_of(ranges_[i], start[i]));
    std::vector<TriedPoint> candidates = {first};
    for (const auto& point : scattered(candidates_of_halving() - 1, "halving"))
      candidates.push_back(at(point));
    halve(candidates);
    refine(std::move(candidates));
    return std::move(result_);
  }

 private:
  TriedPoint at(const std::vector<double>& point) const {
    TriedPoint candidate{.point = point, .values = point};
    for (std::size_t i = 0; i < point.size(); ++i) candidate.values[i] = ranges_[i].at(point[i]);
    return candidate;
  }

  std::vector<std::vector<double>> scattered(std::size_t points, const std::string& name) const {
    return sobol_sequence(points, ranges_.size(), {plan_.seed, "staged_search/" + name});
  }

  /// What halving so many to the finalists costs: each rung but the first runs half of the rung's
  /// trials anew.
  std::size_t cost_of_halving(std::size_t candidates) const {
    std::size_t cost = candidates * plan_.first_trials, trials = plan_.first_trials;
    for (auto left = candidates / 2; left >= finalists; left /= 2, trials *= 2)
      cost += left * trials;
    return cost;
  }

  std::size_t candidates_of_halving() const {
    std::size_t candidates = fewest_candidates;
    while (2 * candidates <= most_candidates && cost_of_halving(2 * candidates) <= plan_.runs / 3)
      candidates *= 2;
    return candidates;
  }

  double objective_of(const TriedPoint& candidate) const {
    const double value = objective_(candidate.numbers);
    return std::isfinite(value) ? value : worst;
  }

  /// Runs what the candidates lack of the first `trials` trials.
  void bring_to(std::span<TriedPoint*> candidates, std::size_t trials) {
    std::vector<std::size_t> had;
    for (const auto* c : candidates) had.push_back(c->numbers.size());
    std::sort(had.begin(), had.end());
    had.erase(std::unique(had.begin(), had.end()), had.end());
    for (const auto first : had) {
      if (first >= trials) continue;
      std::vector<TriedPoint*> some;
      std::vector<std::vector<double>> values;
      for (auto* c : candidates)
        if (c->numbers.size() == first) {
          some.push_back(c);
          values.push_back(c->values);
        }
      const auto numbers = run_(values, first, trials);
      for (std::size_t i = 0; i < some.size(); ++i)
        some[i]->numbers.insert(some[i]->numbers.end(), numbers[i].begin(), numbers[i].end());
      runs_ += some.size() * (trials - first);
    }
  }
  void bring_to(std::vector<TriedPoint>& candidates, std::size_t trials) {
    std::vector<TriedPoint*> all;
    for (auto& c : candidates) all.push_back(&c);
    bring_to(all, trials);
  }

  /// Best first; the earlier of two alike, so that a start that nothing beats stays.
  void sort(std::vector<TriedPoint>& candidates) const {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const TriedPoint& a, const TriedPoint& b) {
                       return objective_of(a) < objective_of(b);
                     });
  }

  void note(const std::string& what, std::size_t looked_at, const TriedPoint& best) {
    result_.values = best.values;
    result_.stages.push_back({.what = what,
                              .candidates = looked_at,
                              .trials = best.numbers.size(),
                              .runs = runs_,
                              .best = best.values,
                              .objective = objective_of(best)});
  }

  void halve(std::vector<TriedPoint>& candidates) {
    std::size_t trials = plan_.first_trials;
    for (int rung = 1;; ++rung, trials *= 2) {
      bring_to(candidates, trials);
      if (rung == 1) {
        note("start", 1, candidates.front());
        result_.stages.back().runs = trials;
      }
      const auto looked_at = candidates.size();
      sort(candidates);
      note("halving " + std::to_string(rung), looked_at, candidates.front());
      if (looked_at <= finalists) return;
      candidates.resize(std::max(finalists, looked_at / 2));
    }
  }

  /// As many rounds, and in each as many trials, as what is left pays for.
  void refine(std::vector<TriedPoint> known) {
    const std::size_t halved = known.front().numbers.size();
    const std::size_t points = surrogate_terms(ranges_.size()) + ranges_.size() + 1;
    const std::size_t left = plan_.runs > runs_ ? plan_.runs - runs_ : 0;
    std::size_t trials = 0;
    int affordable = rounds;
    for (; affordable > 0; --affordable) {
      const std::size_t looks = static_cast<std::size_t>(affordable) * (points + 1);
      trials = (left + known.size() * halved) / (looks + known.size());
      if (trials >= halved) break;
    }
    if (affordable == 0) return;
    bring_to(known, trials);
    sort(known);
    double radius = first_radius;
    for (int round = 1; round <= affordable; ++round, radius /= 2.0) {
      const auto what = "surrogate " + std::to_string(round);
      const auto centre = known.front().point;
      std::vector<TriedPoint> fresh;
      for (const auto& u : scattered(points, what)) {
        auto point = centre;
        for (std::size_t i = 0; i < point.size(); ++i)
          point[i] = std::clamp(centre[i] + radius * (2.0 * u[i] - 1.0), 0.0, 1.0);
        fresh.push_back(at(point));
      }
      bring_to(fresh, trials);
      known.insert(known.end(), fresh.begin(), fresh.end());
      std::vector<TriedPoint> foretold = {at(predicted(known, centre, radius))};
      bring_to(foretold, trials);
      known.push_back(std::move(foretold.front()));
      sort(known);
      note(what, points + 1, known.front());
    }
  }

  /// The minimum of the surrogate of what is known in the region and a little around it.
  std::vector<double> predicted(const std::vector<TriedPoint>& known,
                                const std::vector<double>& centre, double radius) const {
    constexpr double around = 1.5;
    std::vector<std::vector<double>> points;
    std::vector<double> heights;
    for (const auto& c : known) {
      const double height = objective_of(c);
      bool near = height < worst;
      for (std::size_t i = 0; i < centre.size(); ++i)
        near = near && std::abs(c.point[i] - centre[i]) <= around * radius;
      if (!near) continue;
      points.push_back(c.point);
      heights.push_back(height);
    }
    return points.empty() ? centre : surrogate_minimum(points, heights, centre, radius);
  }

  const std::vector<SearchRange>& ranges_;
  const StagedSearchPlan& plan_;
  const CandidateTrials& run_;
  const std::function<double(std::span<const double>)>& objective_;
  std::size_t runs_ = 0;
  StagedSearchResult result_;
};

}  // namespace

double fraction_of(const SearchRange& range, double value) {
  const double fraction = range.low > 0.0
                              ? std::log(value / range.low) / std::log(range.high / range.low)
                              : (value - range.low) / (range.high - range.low);
  return std::clamp(fraction, 0.0, 1.0);
}

StagedSearchResult staged_search(const std::vector<SearchRange>& ranges,
                                 const std::vector<double>& start, const StagedSearchPlan& plan,
                                 const CandidateTrials& run,
                                 const std::function<double(std::span<const double>)>& objective) {
  return StagedSearch(ranges, plan, run, objective).search(start);
}

}  // namespace gyrostat
