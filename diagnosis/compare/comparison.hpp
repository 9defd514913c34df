#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/compare/added.hpp>
#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>

namespace gyrostat::gap {

/// A recording, or what the user's simulator made in its place.
struct NamedSeries {
  std::string name;
  Series series;  ///< evenly sampled; NaN: missing
};

struct ComparisonOptions {
  std::uint64_t seed = 1;
  std::vector<std::string> without;  ///< effects left out of the catalogue
  double significance = 0.02;
};

/// What the simulator does with an effect, as against the recording.
enum class Differs { lacks, too_little, too_much, other_form };
std::string_view name_of(Differs how);

struct Difference {
  std::string effect;  ///< of the catalogue, `white_noise` or `random_walk`
  Differs how;
  /// Log-likelihood that one form for both costs against one each: of the whole that recording and
  /// simulator lose together.
  double log_odds = 0.0;
  double p = 1.0;  ///< of that by chance; for all effects compared, unless segments differ anyway
  std::vector<Effect> real, simulated;         ///< fitted to either; empty where it is not there
  double real_std = 0.0, simulated_std = 0.0;  ///< of white noise, dps; of the walk, dps/√s
  Addition addition;                     ///< that would mend it; nothing where nothing can be added
  double gap_after = 0.0, closed = 0.0;  ///< held-out, of this one mended alone
};

/// An effect that one side has and of which the other is too short to say that it has not.
struct Undecided {
  std::string effect, why;
};

struct Power {
  double louder;  ///< noise larger by this share
  double power;   ///< how often traces as many and as long would show it
};

struct Comparison {
  std::size_t real_traces = 0, simulated_traces = 0;
  double rate_hz = 0.0;
  std::size_t segments_real = 0, segments_simulated = 0;
  double segment_s = 0.0;
  double p_before = 1.0, p_after = 1.0;  ///< by relabelled segments of the train parts
  double gap_before = 0.0, gap_after = 0.0, closed = 0.0, closed_low = 0.0, closed_high = 0.0;
  std::vector<Where> where, where_after;  ///< "simulated" is the user's simulator, and mended
  std::vector<Band> bands;                ///< of segments; before and after it is mended
  std::vector<Difference> differences;    ///< those that close most first
  std::vector<Undecided> undecided;
  std::vector<std::string> in_recording, in_simulator;  ///< effects found in either
  Verdict verdict = Verdict::none();
  std::vector<Verdict> verdict_set;
  std::vector<Enrichment> enrichments;
  std::vector<Shortfall> not_assessable;
  std::vector<Power> power;
  Addition addition;               ///< all that can be mended
  std::vector<Series> with_added;  ///< the simulated traces, mended
};

/// Where a simulator differs from recordings, told by traces of either alone.
///
/// Whether they differ is asked of segments, each read by all lenses, by relabelling (two_samples).
/// In what they differ is asked of likelihoods: the set of effects of every trace is found
/// (find_set), and an effect is a difference where one form for both sides costs too much. With D
/// the log-likelihood that the one side loses by the other's form, or without the effect, and A
/// that which the other loses by the one's, the best form in between costs about D A / (D + A)
/// (both fall as the square of the way to it). Twice that is chi-square. Whatever noise the other
/// side has may stand in for what is held. Of a slow curve that one side lacks, A is what it would
/// be worth in that side's traces were it added to them. Sizes of slow curves and what is read off
/// single samples are compared by their parameters and standard errors (Wald).
///
/// Where segments differ, that there is a difference is known at half of the significance, and an
/// effect is named at the other half; where they do not, at that half for all effects together: for
/// as many as are looked for where one side alone has it, that it is there, and for as many as were
/// found, that the other lacks it. Noise that every segment holds (white, coloured, of a line) is a
/// difference only where segments differ.
///
/// Which effects are there is decided by the train parts; how far the gap closes once they are
/// added to the simulated traces, by the parts held out.
///
/// Throws InputError where there are no traces on a side, one is shorter than 4096 samples or never
/// changes, or rates of sampling differ by more than one in a hundred.
///
/// Thread safety: as diagnose.
Comparison compare(const std::vector<NamedSeries>& recordings,
                   const std::vector<NamedSeries>& simulated, const ComparisonOptions& options,
                   const DiagnosisProgress& progress = {}, const Interrupt& interrupt = {});

}  // namespace gyrostat::gap
