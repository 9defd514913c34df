#include <gyrostat/analysis/search/staged_search.hpp>

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <gyrostat/analysis/search/quadratic_surrogate.hpp>
#include <gyrostat/core/random.hpp>

namespace gyrostat::staged_search_test {
namespace {

using Point = std::vector<double>;

double mean(std::span<const double> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

/// (1 + d²) (1 + noise of the trial): the least mean is at `best`; a turned bowl.
struct Bowl {
  Point best;
  double noise = 0.3;
  std::size_t runs = 0, last_trial = 0;

  double height(const Point& x) const {
    double sum = 0.0, all = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double d = x[i] - best[i];
      sum += d;
      all += 4.0 * d * d;
    }
    return 1.0 + all + 3.0 * sum * sum;
  }
  std::vector<std::vector<double>> operator()(const std::vector<Point>& candidates,
                                              std::size_t first, std::size_t last) {
    const NormalStream stream(7, 0, "bowl");
    std::vector<std::vector<double>> numbers;
    for (const auto& x : candidates) {
      auto& row = numbers.emplace_back();
      for (auto t = first; t < last; ++t)
        row.push_back(height(x) * (1.0 + noise * stream.normal(t)));
    }
    runs += candidates.size() * (last - first);
    last_trial = std::max(last_trial, last);
    return numbers;
  }
};

StagedSearchResult search(Bowl& bowl, std::size_t runs, const Point& start) {
  const std::vector<SearchRange> box(bowl.best.size(), {-1.0, 1.0});
  return staged_search(box, start, {.runs = runs}, std::ref(bowl), mean);
}

TEST(StagedSearch, FindsTheLeastMeanThroughCommonNoise) {
  Bowl bowl{.best = {0.31, -0.22, 0.65}};
  const auto found = search(bowl, 8000, {0.9, 0.9, -0.9});
  EXPECT_LT(bowl.height(found.values), 1.002);
  EXPECT_LE(bowl.runs, 8000U);
  EXPECT_GT(bowl.runs, 7000U);
}

TEST(StagedSearch, FindsAMinimumOnTheEdge) {
  Bowl bowl{.best = {1.0, -1.0}};
  EXPECT_LT(bowl.height(search(bowl, 6000, {0.0, 0.0}).values), 1.01);
}

TEST(StagedSearch, SpendsNoMoreThanItsRunsAndTellsThem) {
  for (const std::size_t runs : {400U, 1000U, 3000U, 20000U}) {
    Bowl bowl{.best = {0.2, 0.4}};
    const auto found = search(bowl, runs, {0.0, 0.0});
    EXPECT_LE(bowl.runs, runs);
    EXPECT_EQ(found.stages.back().runs, bowl.runs);
    EXPECT_EQ(found.stages.front().what, "start");
  }
}

TEST(StagedSearch, KeepsAStartThatNothingBeats) {
  Bowl bowl{.best = {0.2, 0.4}};
  EXPECT_EQ(search(bowl, 4000, {0.2, 0.4}).values, (Point{0.2, 0.4}));
}

TEST(StagedSearch, NumbersThatAreNoneAreWorst) {
  const std::vector<SearchRange> box = {{0.0, 1.0}};
  const auto found = staged_search(
      box, {0.9}, {.runs = 2000},
      [](const std::vector<Point>& candidates, std::size_t first, std::size_t last) {
        std::vector<std::vector<double>> numbers;
        for (const auto& x : candidates)
          numbers.emplace_back(last - first, x[0] < 0.5 ? std::nan("") : x[0]);
        return numbers;
      },
      mean);
  EXPECT_GE(found.values[0], 0.5);
  EXPECT_LT(found.values[0], 0.5 + 0.0625);  // the last region reaches so far
}

TEST(StagedSearch, AFractionIsTheInverseOfAValue) {
  for (const SearchRange range : {SearchRange{0.01, 10.0}, SearchRange{-3.0, 2.0}})
    for (const double fraction : {0.0, 0.1, 0.7, 1.0})
      EXPECT_NEAR(fraction_of(range, range.at(fraction)), fraction, 1e-12);
}

TEST(QuadraticSurrogate, OfAQuadraticHasItsMinimum) {
  std::vector<Point> points;
  std::vector<double> heights;
  for (int i = 0; i < 12; ++i) {
    const double x = 0.5 + 0.2 * std::cos(i), y = 0.5 + 0.2 * std::sin(1.7 * i);
    points.push_back({x, y});
    heights.push_back((x - 0.6) * (x - 0.6) + (x - 0.6) * (y - 0.45) + (y - 0.45) * (y - 0.45));
  }
  const auto found = surrogate_minimum(points, heights, {0.5, 0.5}, 0.25);
  EXPECT_NEAR(found[0], 0.6, 1e-4);
  EXPECT_NEAR(found[1], 0.45, 1e-4);
  EXPECT_NEAR(surrogate_minimum(points, heights, {0.4, 0.5}, 0.1)[0], 0.5, 1e-4);  // at its end
}

}  // namespace
}  // namespace gyrostat::staged_search_test
