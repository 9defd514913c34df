#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/gap/scoring.hpp>
#include <gyrostat/diagnosis/start.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {

inline constexpr std::size_t fit_replicas = 3;

/// A start, or what became of it, with its replicas' readings and its score.
struct Contender {
  std::string effect;
  Scenario scenario;
  ReplicaReadings replicas;
  LogScore score;
  std::size_t parameters = 0;
  double before = 0.0;     ///< the score of what it was added to
  double baseline = 0.0;   ///< the baseline's score
  double most_gain = 0.0;  ///< more is not the effect's
  bool misnamed = false;   ///< its parameters are not what its name says
  bool idle = false;       ///< without it, the rest as fitted foretells the recording as well

  double gain() const {
    return std::min(score.value - before, most_gain) -
           (misnamed || idle ? thresholds::disqualified : 0.0);
  }
};

/// Share of the log score beyond `from` that a simulator has of what a true one would have.
double recovered(const Contender& c, double from);

/// Effects tried on the train part of one recording, one added after another: each effect's starts
/// are screened with a few replicas, the promising are fitted, and all are held against what they
/// are added to.
class Contest {
 public:
  /// What is being done, with the share that is done.
  using Tell = std::function<void(const std::string&, double)>;
  /// A part of the work that has ended.
  using Took = std::function<void(const std::string&)>;

  Contest(const Evidence& evidence, const Scoring& scoring, const Eigen::VectorXd& observed,
          const ReplicaReadings& baseline_replicas, const DiagnosisOptions& options, Tell tell,
          Took took);

  /// The best of all assessable effects that are not added yet, fitted, the likeliest first.
  std::vector<Contender> contend();
  /// A scenario whose last effect is held against what has been added so far.
  Contender judged(const std::string& effect, const Scenario& scenario, std::size_t replicas,
                   double most_gain, std::span<const Part> of = parts) const;
  void add(Contender contender) { added_.push_back(std::move(contender)); }

  const std::vector<Contender>& added() const { return added_; }
  /// Every effect that was screened, with its gain at its best start.
  const std::vector<std::pair<std::string, double>>& screening() const { return screening_; }

 private:
  void find_starts();
  std::vector<Contender> screened();
  double score_of(const ReplicaReadings& of, std::size_t replicas) const;
  double score_without(const Contender& contender) const;

  const Evidence& evidence_;
  const Simulator& simulator_;
  const Scoring& scoring_;
  const Eigen::VectorXd& observed_;
  const ReplicaReadings& baseline_replicas_;
  const DiagnosisOptions& options_;
  Tell tell_;
  Took took_;
  std::vector<std::pair<std::string, std::vector<Start>>> starts_;  ///< of every assessable effect
  std::vector<Contender> added_;
  std::vector<std::pair<std::string, double>> screening_;
};

}  // namespace gyrostat::gap
