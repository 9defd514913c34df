#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <gyrostat/core/random.hpp>

namespace gyrostat {

/// How a rare failure is looked for: that a function of standard normal deviates is above a
/// threshold.
struct SubsetPlan {
  double threshold = 0.0;
  std::uint32_t samples = 380;     ///< of each level
  std::uint32_t most_levels = 10;  ///< after so many it is rarer than can be told
  double share = 0.1;              ///< of a level's samples, from which the next one grows

  /// Numbers of trials that a run has for its own, most of which it never asks for.
  std::uint32_t numbers() const { return samples * most_levels; }
};

/// A trial that a run wants to know the function's value of. Its deviates are
/// sqrt(1 - spread^2) those of trial `parent` + spread those drawn at its own number.
struct SubsetMove {
  std::uint32_t trial = 0, parent = 0;
  double spread = 1.0;  ///< 1: without a parent

  bool operator==(const SubsetMove&) const = default;
};

/// A level: of its samples, `share` are above `threshold`.
struct SubsetLevel {
  double threshold = 0.0;
  double share = 0.0;
  double acceptance = 1.0;  ///< of its moves; 1 in the first level, which has none
  double spread = 1.0;      ///< of its last moves
  std::uint32_t chains = 0;
};

/// One run of subset simulation (Au and Beck, Prob. Eng. Mech. 16, 2001). The first level's
/// samples are plain trials. Those above a threshold that a tenth of them reach are the seeds of
/// chains that stay above it, which are the next level's samples, and so on up to the threshold
/// asked for; the probability is the product of the levels' shares. A chain moves all deviates at
/// once (Papaioannou, Betz, Zwirglmaier and Straub, Prob. Eng. Mech. 41, 2015, eq. 21), which works
/// in any number of dimensions, by a spread that is adapted link by link to an acceptance of 0.44
/// over all of a level's chains (their eq. 27).
///
/// It is asked and told, and draws nothing itself: which trials it asks for depends on what it was
/// told alone, so that a run is resumed by telling it again. The deviates of a trial are a mixture
/// of addressed ones (`shares`), so that each can be made again by its number.
///
/// Example: the probability that a standard normal deviate is above 5, which is 2.9e-7.
///
///   SubsetSimulation run({.threshold = 5.0, .samples = 2000}, 0);
///   while (!run.asked().empty()) {
///     std::vector<double> values;
///     for (const auto& move : run.asked()) {
///       const auto shares = run.shares(move);
///       values.push_back(NormalStream(1, move.trial, "z", shares, nullptr).normal(0));
///     }
///     run.tell(values);
///   }
///   std::printf("%g\n", run.probability());
class SubsetSimulation {
 public:
  /// Its trials are numbered from `first`, `plan.numbers()` at most.
  SubsetSimulation(const SubsetPlan& plan, std::uint32_t first);

  /// The trials that it waits for; none once it has ended.
  const std::vector<SubsetMove>& asked() const { return asked_; }
  /// Their values, in the order in which they were asked for; none is NaN.
  void tell(std::span<const double> values);

  /// Of what trials' deviates those of a move are mixed, itself last.
  std::vector<NoiseShare> shares(const SubsetMove& move) const;
  /// The move that made a trial; throws std::out_of_range where there was none.
  const SubsetMove& move(std::uint32_t trial) const { return moves_.at(trial); }

  /// Whether the threshold was reached. Otherwise the run ended at its last level, or because
  /// the function has one value at all the samples of a level.
  bool reached() const { return reached_; }
  double probability() const;  ///< once it has ended; 0 where the threshold was not reached
  /// The probability beyond the highest threshold that samples were found beyond: the failure's
  /// own once the threshold was reached, else that of something no rarer. Never 0.
  double bound() const;
  const std::vector<SubsetLevel>& levels() const { return levels_; }
  std::uint32_t trials() const { return trials_; }  ///< that it was told of
  /// The trials above the threshold, each as often as a chain stayed there.
  const std::vector<std::uint32_t>& failing() const { return failing_; }

 private:
  struct State {
    std::uint32_t trial;
    double value;
  };
  void end_level();
  void begin_level(std::vector<State> seeds);
  void ask();

  SubsetPlan plan_;
  std::uint32_t first_;
  std::vector<SubsetMove> asked_;
  std::map<std::uint32_t, SubsetMove> moves_;
  std::vector<State> chains_, samples_;  ///< where chains are; the level's samples so far
  std::vector<SubsetLevel> levels_;
  std::vector<std::uint32_t> failing_;
  double above_ = 0.0;   ///< what this level's samples are above; of no meaning in the first
  double spread_ = 0.6;  ///< as their first, section 5
  std::uint32_t links_ = 0, accepted_ = 0, moved_ = 0, trials_ = 0;
  bool reached_ = false;
};

/// A probability by independent runs of subset simulation.
struct RareProbability {
  double probability = 0.0;  ///< mean of the runs
  double low = 0.0, high = 1.0;
  double variation = 0.0;  ///< coefficient of variation of that mean, by how the runs differ
  double reliability_index() const;
  /// How many plain trials would have told it as well.
  double plain_trials() const;
};

/// Of the probabilities of at least two runs that reached the threshold. Runs are skewed, near
/// log-normal: the 95 % interval is that of a log-normal mean, Student's t times
/// sqrt(s^2 / n + s^4 / (2 (n - 1))) about it in the logarithm (after Cox, in Land, Technometrics
/// 14, 1972; with t by Olsson, J. Stat. Educ. 13, 2005). Its coverage is measured by the tests.
RareProbability rare_probability(std::span<const double> runs);

/// The 97.5 % upper bound of a failure's probability that runs leave which did not all reach the
/// threshold, of their `bound`s: the upper end of `rare_probability`'s interval for the mean of
/// what is no rarer.
double rarer_than(std::span<const double> bounds);

/// Lets every run end by values of `function` of `dimension` deviates, of stream "z".
void complete(SubsetSimulation& run, std::uint64_t seed, std::size_t dimension,
              const std::function<double(std::span<const double>)>& function);

}  // namespace gyrostat
