#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/diagnosis/likelihood/detectable.hpp>
#include <gyrostat/diagnosis/likelihood/nameless.hpp>
#include <gyrostat/diagnosis/likelihood/transient.hpp>
#include <gyrostat/diagnosis/likelihood/unexplained.hpp>
#include <gyrostat/diagnosis/line_source.hpp>
#include <gyrostat/diagnosis/next_experiment.hpp>
#include <gyrostat/diagnosis/portrait.hpp>
#include <gyrostat/diagnosis/transfer.hpp>
#include <gyrostat/diagnosis/verdict.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

struct DiagnosisOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> without;  ///< effects left out of the catalogue
  /// Effects, if any, and random error found elsewhere, to be judged here instead of looking for
  /// causes.
  std::optional<Scenario> claim;
  std::size_t baseline_replicas = 100;
  std::size_t candidate_replicas = 32;
  double significance = 0.02;
};

/// A reading at which the recording leaves the simulator.
struct Where {
  std::string lens, channel, coordinate, unit;
  double from, to, observed, simulated, p_adjusted;
};

/// A candidate, fitted on the train part.
struct Cause {
  std::string effect;
  Scenario scenario;       ///< the baseline with the effect, both fitted
  double log_score = 0.0;  ///< of the train part, beyond the scenario without the effect
  double recovered = 0.0;  ///< share of the log score that a true cause would gain
  double probability = 0.0;
  double gap_after = 0.0;  ///< held-out
  double closed = 0.0;
};

/// An effect of the set that was found.
struct Included {
  std::string effect;
  double inclusion = 0.0;    ///< probability that it is there
  double log_odds = 0.0;     ///< of the set against the best without it
  double lack = 0.0;         ///< log score of the train part that the set loses without it
  double gap_without = 0.0;  ///< held-out, of the set without it
  bool given = false;    ///< fitted once for all axes (diagnose_axes()), as `inclusion` is of them
  double p_equal = 1.0;  ///< then: that chance makes equal axes differ as each was found alone
  std::vector<Effect> parameters;  ///< fitted; several where it is there several times
  /// Of the first of them: where the recording tells, between which values each field lies with
  /// 95 %; NaN elsewhere.
  std::vector<std::array<double, 2>> intervals{};
};

/// What named effects leave, modelled without a name.
struct Remainder {
  std::vector<Nameless> parts;  ///< none: nothing, or nothing that helps
  Scenario scenario;            ///< the enriched one with them
  double gap = 0.0;             ///< held-out
  double closed = 0.0;          ///< by named and nameless parts together
  std::vector<Where> where{};   ///< on the train part, beside all parts
};

/// The simulator with one more effect.
struct Enrichment {
  std::string added;  ///< nothing for the baseline
  double gap = 0.0;   ///< held-out
};

struct Shortfall {
  std::string effect, why;
};

/// Readings of one lens on the held-out part, for pictures.
struct Band {
  std::string lens, title, channel, coordinate, unit;
  std::vector<double> at, observed, before, before_spread, after, after_spread;
};

struct Diagnosis {
  std::size_t samples = 0;
  double duration_s = 0.0, rate_hz = 0.0;
  std::vector<std::string> channels;
  Scenario baseline;
  Scenario enriched;  ///< with every effect that was added; the baseline where none was
  std::vector<Where> where, where_after;  ///< on the train part, before and after the effects
  std::vector<Unexplained> unexplained;   ///< that the likelihood sees beside the effects
  std::optional<Transient> transient;     ///< beside the effects, where it is beyond chance
  double gap_before = 0.0, gap_after = 0.0, closed = 0.0, closed_low = 0.0, closed_high = 0.0;
  double p_before = 1.0, p_after = 1.0;  ///< of the train part
  double p_held_out = 1.0;               ///< of the held-out part, with the effects
  /// Another part was held out than is at first, which has what no other has.
  bool other_part_held_out = false;
  /// Log-likelihood of the set less its cost, beyond the baseline's, in nats, on the train part;
  /// none where samples do not count for it.
  std::optional<double> log_score_gained;
  std::vector<Included> effects;  ///< the set, those that close most first
  double recovered = 0.0;     ///< share of the log score that a true simulator would have gained
  std::vector<Cause> causes;  ///< those of the set, then their rivals
  Remainder remainder;
  Verdict verdict = Verdict::none();
  bool claimed = false;                   ///< the causes were given, not found
  std::vector<Verdict> verdict_set;       ///< what the recording cannot rule out
  std::vector<Enrichment> enrichments;    ///< of the baseline, one after another
  std::vector<LineWitness> line_sources;  ///< of those effects that are lines
  std::vector<Shortfall> not_assessable;
  std::vector<Detectable> detectable;  ///< what would have been found beside the set, if so large
  std::vector<Transfer> transfer;
  NextExperiment next;  ///< empty where nothing is open
  std::vector<Band> bands;
  Portrait portrait;
  std::vector<std::pair<std::string, double>> screening;  ///< log scores at the starts
  std::vector<std::pair<std::string, double>> seconds;    ///< spent in each part of the work
};

/// How far a diagnosis is.
struct DiagnosisStage {
  std::string phase;   ///< as "looking for effects"
  std::string detail;  ///< what of it was just done, or nothing
  double share;        ///< of the work that is done; only grows
};
using DiagnosisProgress = std::function<void(const DiagnosisStage&)>;

/// Diagnoses an evenly sampled series (NaN = missing). Everything that is chosen or fitted comes
/// from the train part alone; the other may only add that something is unknown. Where that has what
/// the rest of the recording does not have, another part is held out in its place, and stays so if
/// effects are then found that were not, and that part is not missed. Throws InputError for fewer
/// than 1000 samples, or a gyro that never changes.
///
/// Example: the verdict on a recording, in words.
///
///   #include <gyrostat/diagnosis/diagnosis_tables.hpp>
///
///   const Series recording = read_recording("REC.csv").series;
///   const gap::Diagnosis diagnosis = gap::diagnose(recording, {.seed = 1});
///   std::fputs(gap::in_words(diagnosis, "REC.csv").c_str(), stdout);
///
/// Thread safety: may be called from any thread; it works on all threads that oneTBB gives it, and
/// their number changes no digit. `progress` is called by the thread that called; once `interrupt`
/// says so, Interrupted is thrown within a moment.
Diagnosis diagnose(const Series& recording, const DiagnosisOptions& options,
                   const DiagnosisProgress& progress = {}, const Interrupt& interrupt = {});

/// The same of several axes of one sensor, of which each is told by its number and how far it is:
/// what of them is alike (CauseType::part: the filter of the noise, a grid of the angle, how the
/// temperature gets there) is fitted once, where their likelihoods together are larger so, and the
/// others of each axis beside that.
///
/// Throws and is called as diagnose().
std::vector<Diagnosis> diagnose_axes(
    const std::vector<Series>& axes, const DiagnosisOptions& options,
    const std::function<void(std::size_t axis, const DiagnosisStage&)>& progress = {},
    const Interrupt& interrupt = {});

/// Every effect that may be named as a cause, with its default parameters, in the catalogue's
/// order.
std::vector<Effect> catalogue();

}  // namespace gyrostat::gap
