#pragma once

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/gap/ensemble.hpp>
#include <gyrostat/diagnosis/gap/scoring.hpp>
#include <gyrostat/diagnosis/likelihood/set_search.hpp>
#include <gyrostat/diagnosis/simulator.hpp>

namespace gyrostat::gap {

/// All the noise of a compass there is, where a scenario has it (with_nameless).
inline constexpr std::string_view nameless_compass = "empirical_compass_noise";

/// Replicas that say what a set lacks without one of its effects.
inline constexpr std::size_t lacking_replicas = 16;

/// A simulator with some of the set's effects.
struct Rung {
  std::string effect;  ///< the last of them
  Scenario scenario;
  ReplicaReadings replicas;
};

/// Of odds, in nats.
inline double probability_of(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

/// One diagnosis in the making: the set that the search finds, what each of its effects is worth,
/// and how far they close the gap. `diagnose` runs it.
class Diagnosing {
 public:
  Diagnosing(const Series& recording, const DiagnosisOptions& options,
             const DiagnosisProgress& progress, const Interrupt& interrupt, Split split)
      : options_(options),
        progress_(progress),
        simulator_(recording, options.seed, interrupt, split),
        recording_(recording),
        observed_(simulator_.readings(recording)) {}

  /// Looks for the set, if that has not been done; run() does.
  const FoundSet& search();
  /// The set is the one that is found beside these.
  void take(const std::vector<Given>& given);
  Diagnosis run();

 private:
  static constexpr double search_share = 0.55;  ///< of the work, as it is told

  void tell(const std::string& phase, double share, const std::string& detail = {});
  void took(const std::string& part);
  void describe(const Series& recording);
  void localise();
  /// With the drift that the recording has beside the effects.
  Scenario with_drift(Scenario scenario, const Series& recording) const;
  std::vector<Where> departures_of(const Ensemble& ensemble) const;
  void attribute();
  /// Puts it in the verdict's set, once.
  void cannot_rule_out(const Verdict& verdict);
  /// What each of the set's effects is worth: their names. Where the simulator with all of them
  /// misses the recording, its likelihood is not the recording's, and what is needless goes.
  std::vector<std::string> weighed(std::vector<Member> members, const std::string& phase);
  /// Those that are not clear and without which the readings of the train part are foretold as
  /// well: one that is the form of another, or two, the last first. `whole` is then the simulator
  /// without them; `without` are those without one each.
  std::vector<std::size_t> needless_among(const std::vector<Member>& members,
                                          std::vector<Rung> without, Rung& whole);
  /// Whether the search without the least clear of these effects, and without its rivals, finds a
  /// set with which the simulator does not miss the recording, as it does with all of them: it then
  /// stands. The likelihood of the noise is Gaussian, and what is nearly as likely may have another
  /// distribution.
  bool is_found_without_a_doubtful(const std::vector<std::string>& names);
  bool is_missed_by(const Rung& rung) const;
  /// Log odds of a likelihood that is as far off as the readings of its channel say, beside the
  /// set: over their mean square deviation (quasi-likelihood; Wedderburn, Biometrika 61, 1974).
  /// What is read off the values has no likelihood of the noise.
  double tempered(const Member& member, const Rung& set) const;
  void temper();
  void judge_claim();
  Rung rung(const std::string& effect, const Scenario& scenario, std::size_t replicas) const;
  /// The scenario with those of the set's effects that have one of the names, its noise fitted.
  Scenario with_effects(std::vector<std::string> names);
  void add_intervals(Included& included) const;
  std::vector<std::size_t> by_what_each_closes(const std::vector<std::string>& names);
  void climb(const std::vector<std::string>& order);
  /// What the recording still shows that the simulator, enriched, does not.
  void see_what_is_left();
  bool is_left_in_the_compass_alone() const;
  /// What effects of the rate leave is seen in the heading alone: it casts no doubt on them.
  bool only_the_compass_is_left() const;
  /// With what has no name.
  void complete();
  void measure_shrinkage();
  void keep_bands();
  void look_ahead();

  const DiagnosisOptions& options_;
  const DiagnosisProgress& progress_;
  Simulator simulator_;
  const Series& recording_;
  Readings observed_;
  std::unique_ptr<Ensemble> train_, held_out_;
  std::unique_ptr<Scoring> scoring_, held_out_scoring_;
  ReplicaReadings baseline_replicas_;
  double p_beside_compass_ = 1.0;  ///< of all that the set leaves but in the heading
  bool has_searched_ = false;
  std::string looking_ = "looking for effects";
  FoundSet found_;
  std::vector<Given> given_;
  std::vector<LogScore> held_out_without_;  ///< of the set without each of result_.effects
  std::map<std::vector<std::string>, Scenario> subsets_;  ///< with_effects() of what was found
  std::vector<Rung> rungs_;                               ///< one effect more each
  std::optional<Rung> yardstick_;  ///< with what of it the likelihood tells, which gaps are held to
  std::optional<Rung> completed_;  ///< with all that has no name
  Diagnosis result_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  double share_ = 0.0;  ///< told
};

}  // namespace gyrostat::gap
