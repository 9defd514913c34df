#include <gyrostat/diagnosis/compare/differences.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/compare/difference_form.hpp>
#include <gyrostat/diagnosis/compare/difference_weight.hpp>

namespace gyrostat::gap {
namespace {

/// Differences that are clear and matter to nobody: of white noise, of the walk.
constexpr double least_of_white = 0.03, least_of_walk = 0.25;

/// Noise that every segment holds and that is fast beside one. Whether it differs, segments tell
/// without a model of it; a likelihood, whose form is not exactly nature's, tells two halves of one
/// recording apart.
bool is_in_every_segment(const CauseType& cause) {
  return cause.enter != nullptr && (cause.effect().stage() == Stage::noise ||
                                    cause.id == "vibration" || cause.id == "wandering_line");
}

class DifferenceSearch {
 public:
  DifferenceSearch(const StudiedSide& real, const StudiedSide& simulated, const Matched& matched,
                   const DifferenceOptions& options)
      : real_(real), simulated_(simulated), matched_(matched), options_(options) {}

  Differences run();

 private:
  bool keep(Difference difference, const Weight& evidence);
  void compare(const CauseType& cause);
  void one_side_alone(const CauseType& cause, const Found& real, const Found& simulated);
  /// Log odds with which the traces of a side would show these effects, had they been added.
  double would_show(const StudiedSide& side, const CauseType& cause,
                    const std::vector<Effect>& effects) const;
  void compare_noise(std::string_view name, double (TraceStudy::*value)() const,
                     double (TraceStudy::*loss)(double) const, double least);
  /// Whether likelihoods may say that it differs.
  bool says(const CauseType& cause) const {
    return options_.segments_differ || !is_in_every_segment(cause);
  }

  const StudiedSide &real_, &simulated_;
  const Matched& matched_;
  const DifferenceOptions& options_;
  double found_ = 0.0;  ///< effects, on either side
  Differences result_;
};

bool DifferenceSearch::keep(Difference difference, const Weight& evidence) {
  difference.log_odds = evidence.log_odds;
  const auto chance = [&](double odds) {
    return chi_squared_upper_tail(2.0 * odds, evidence.parameters);
  };
  const double by_chance = chance(evidence.log_odds);
  if (options_.segments_differ)
    difference.p = by_chance;
  else if (evidence.there)  // an effect of all was found; that it differs is asked of those found
    difference.p =
        std::min(1.0, std::max(matched_.compared * chance(*evidence.there), found_ * by_chance));
  else
    difference.p = std::min(1.0, matched_.compared * by_chance);
  if (difference.p > options_.level) return false;
  result_.found.push_back(std::move(difference));
  return true;
}

double DifferenceSearch::would_show(const StudiedSide& side, const CauseType& cause,
                                    const std::vector<Effect>& effects) const {
  double odds = 0.0;
  for (std::size_t k = 0; k < side.traces.size(); ++k) {
    const auto& plain = *side.traces[k];
    const TraceStudy with(
        plain.mended({.effects = effects}, {options_.seed, static_cast<std::uint32_t>(k)}),
        options_.seed, matched_.without, options_.interrupt, {});
    // A slow curve shows, whichever of its likes it is then taken for.
    odds += cause.signature == Signature::slow
                ? std::max(0.0, with.found().gain - plain.found().gain)
                : with.log_odds(cause.id);
  }
  return odds;
}

void DifferenceSearch::one_side_alone(const CauseType& cause, const Found& real,
                                      const Found& simulated) {
  const bool lacks = simulated.effects.empty();
  const auto& has_it = lacks ? real : simulated;
  const auto& other_side = lacks ? simulated_ : real_;
  double here = has_it.log_odds, there = 0.0;
  // What is taken out sample by sample finds its own size and cannot be held at another's.
  const bool by_law = has_loss(cause) && cause.enter != nullptr;
  if (by_law) {
    const auto losses = losses_of(cause, real_, simulated_);
    here = lacks ? losses.real : losses.simulated;
    there = lacks ? losses.simulated : losses.real;
  } else {
    if (cause.signature == Signature::slow) {
      here = 0.0;
      for (const auto& trace : (lacks ? real_ : simulated_).traces) here += trace->worth(cause.id);
    }
    there = would_show(other_side, cause, has_it.effects);
  }
  auto evidence = by_losses({here, there}, by_law ? double(cause.free_parameters.size()) : 1.0);
  evidence.there = here;
  Difference difference{.effect = std::string(cause.id),
                        .how = lacks ? Differs::lacks : Differs::too_much,
                        .real = real.effects,
                        .simulated = simulated.effects,
                        .addition = {}};
  difference.addition.effects = instead_of(cause, real.effects, simulated.effects);
  if (says(cause) && keep(difference, evidence)) return;
  if (!says(cause)) {
    result_.undecided.push_back(
        {difference.effect, fmt::format("found in the {}, but segments of both are alike",
                                        lacks ? "recording" : "simulated traces")});
    return;
  }
  result_.undecided.push_back(
      {difference.effect,
       fmt::format("found in the {} (worth {:.1f} nats of likelihood); that the {} have it as well "
                   "would cost them {:.1f} nats, which is too little to say that it is not there",
                   lacks ? "recording" : "simulated traces", here,
                   lacks ? "simulated traces" : "recordings", there)});
}

void DifferenceSearch::compare(const CauseType& cause) {
  const auto real = real_.found(cause.id), simulated = simulated_.found(cause.id);
  if (real.effects.empty() && simulated.effects.empty()) return;
  if (real.effects.empty() || simulated.effects.empty()) {
    one_side_alone(cause, real, simulated);
    return;
  }
  const auto how = how_differs(cause, real.effects, simulated.effects);
  if (!how) return;
  Difference difference{.effect = std::string(cause.id),
                        .how = *how,
                        .real = real.effects,
                        .simulated = simulated.effects,
                        .addition = {}};
  difference.addition.effects = instead_of(cause, real.effects, simulated.effects);
  if (says(cause)) (void)keep(difference, weight_of(cause, real_, simulated_));
}

void DifferenceSearch::compare_noise(std::string_view name, double (TraceStudy::*value)() const,
                                     double (TraceStudy::*loss)(double) const, double least) {
  const double real = real_.mean_of(value), simulated = simulated_.mean_of(value);
  if (std::abs(real - simulated) <= least * std::max(real, simulated)) return;
  Difference difference{.effect = std::string(name),
                        .how = real > simulated ? Differs::too_little : Differs::too_much,
                        .real = {},
                        .simulated = {},
                        .real_std = real,
                        .simulated_std = simulated,
                        .addition = {}};
  const double more = std::sqrt(std::max(0.0, real * real - simulated * simulated));
  (name == white_noise ? difference.addition.white_std_dps
                       : difference.addition.walk_dps_per_sqrt_s) = more;
  Losses losses;
  for (const auto& trace : real_.traces) losses.real += (*trace.*loss)(simulated);
  for (const auto& trace : simulated_.traces) losses.simulated += (*trace.*loss)(real);
  (void)keep(difference, by_losses(losses, 1.0));
}

/// The noises of `other` that `side` has not under any name, allowed to its traces.
void allow_noises_of(const StudiedSide& other, const StudiedSide& side) {
  std::vector<Effect> noises;
  for (const auto& cause : cause_types())
    if (has_loss(cause) && cause.enter != nullptr && side.found(cause.id).effects.empty())
      std::ranges::copy(other.found(cause.id).effects, std::back_inserter(noises));
  for (const auto& trace : side.traces) trace->allow(noises);
}

Differences DifferenceSearch::run() {
  allow_noises_of(real_, simulated_);
  allow_noises_of(simulated_, real_);
  auto tell = [&, done = 0.0](std::string_view name) mutable {
    options_.interrupt.check();
    if (options_.progress) options_.progress(std::string(name), done / matched_.compared);
    done += 1.0;
  };
  for (const auto& cause : cause_types())
    if (!real_.found(cause.id).effects.empty() || !simulated_.found(cause.id).effects.empty())
      found_ += 1.0;
  for (const auto& cause : cause_types()) {
    if (std::ranges::find(matched_.without, cause.id) != matched_.without.end()) continue;
    tell(cause.id);
    compare(cause);
  }
  tell(white_noise);
  if (options_.segments_differ)
    compare_noise(white_noise, &TraceStudy::white_std_dps, &TraceStudy::loss_with_white,
                  least_of_white);
  tell(random_walk);
  const auto remembers = [](const auto& trace) { return trace->has_memory(); };
  if (std::ranges::none_of(real_.traces, remembers) &&
      std::ranges::none_of(simulated_.traces, remembers))
    compare_noise(random_walk, &TraceStudy::walk_dps_per_sqrt_s, &TraceStudy::loss_with_walk,
                  least_of_walk);
  return std::move(result_);
}

}  // namespace

Differences differences_between(const StudiedSide& real, const StudiedSide& simulated,
                                const Matched& matched, const DifferenceOptions& options) {
  return DifferenceSearch(real, simulated, matched, options).run();
}

}  // namespace gyrostat::gap
