#include <gyrostat/diagnosis/compare/differences.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

/// Differences that are clear and matter to nobody: of white noise, of the walk, of an effect.
constexpr double least_of_white = 0.03, least_of_walk = 0.25, least_of_effect = 0.05;
constexpr double read_off_the_values = 1e3;  ///< log odds of what is beyond doubt

/// The size that an effect is known by: of what it has in dps, the largest; else the first of its
/// free parameters.
double size_of(const CauseType& cause, const std::vector<Effect>& effects) {
  double size = 0.0;
  for (const auto& effect : effects)
    for (std::size_t i = 0; i < effect.fields().size(); ++i)
      if (effect.fields()[i].unit == "dps") size = std::max(size, std::abs(effect.value(i)));
  if (size == 0.0 && !effects.empty() && !cause.free_parameters.empty())
    size = std::abs(effects.front().value(field_of(effects.front(), cause.free_parameters[0])));
  return size;
}

bool differ_enough(const std::vector<Effect>& a, const std::vector<Effect>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].fields().size(); ++i) {
      const double x = a[k].value(i), y = b[k].value(i);
      if (std::abs(x - y) > least_of_effect * std::max(std::abs(x), std::abs(y))) return true;
    }
  return false;
}

/// A slow curve is linear in its amplitudes: the simulated one is taken out, the real one put in.
std::vector<Effect> instead_of(const CauseType& cause, std::vector<Effect> real,
                               std::vector<Effect> simulated) {
  if (cause.signature != Signature::slow) return simulated.empty() ? real : std::vector<Effect>{};
  for (auto& effect : simulated) {
    for (std::size_t a = 0; a < cause.amplitudes; ++a)
      effect.value(field_of(effect, cause.free_parameters[a])) *= -1.0;
    real.push_back(std::move(effect));
  }
  return real;
}

/// Evidence for one form each, and how many parameters it is about.
struct Weight {
  double log_odds = 0.0, parameters = 1.0;
  /// Where one side alone has it: that this side has it at all.
  std::optional<double> there = {};
};

/// Noise that every segment holds and that is fast beside one. Whether it differs, segments tell
/// without a model of it; a likelihood, whose form is not exactly nature's, tells two halves of one
/// recording apart.
bool is_in_every_segment(const CauseType& cause) {
  return cause.enter != nullptr && (cause.effect().stage() == Stage::noise ||
                                    cause.id == "vibration" || cause.id == "wandering_line");
}

/// Log-likelihood that each side loses by the other's form of an effect, which may be none.
struct Losses {
  double real = 0.0, simulated = 0.0;
};

/// The common form costs least where it lies between both.
Weight by_losses(double loss_real, double loss_simulated, double parameters) {
  const double both = loss_real + loss_simulated;
  return {both > 0.0 ? loss_real * loss_simulated / both : 0.0, std::max(1.0, parameters)};
}

/// Half of the squared differences of parameters over their errors.
Weight by_errors(const Found& real, const Found& simulated) {
  Weight evidence{0.0, 0.0};
  const auto &a = real.effects.front(), &b = simulated.effects.front();
  for (std::size_t i = 0; i < a.fields().size(); ++i) {
    const double error = std::hypot(real.errors[i], simulated.errors[i]);
    if (is_missing(error) || !(error > 0.0)) continue;
    evidence.log_odds += 0.5 * std::pow((a.value(i) - b.value(i)) / error, 2);
    evidence.parameters += 1.0;
  }
  evidence.parameters = std::max(1.0, evidence.parameters);
  return evidence;
}

/// Read off the values themselves, by no likelihood.
bool is_read_off(const CauseType& cause) {
  return cause.id == "quantization" || cause.id == "saturation" || cause.id == "stale_samples";
}

/// Whether TraceStudy::loss_with knows what another form of the effect costs.
bool has_loss(const CauseType& cause) {
  return !is_read_off(cause) && cause.signature != Signature::slow &&
         (cause.enter != nullptr || cause.signature == Signature::repeated) &&
         cause.effect().stage() != Stage::compass;
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
  Weight evidence_of(const CauseType& cause, const Found& real, const Found& simulated) const;
  Losses losses_of(const CauseType& cause, const Found& real, const Found& simulated) const;
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
    const auto losses = losses_of(cause, real, simulated);
    here = lacks ? losses.real : losses.simulated;
    there = lacks ? losses.simulated : losses.real;
  } else {
    if (cause.signature == Signature::slow) {
      here = 0.0;
      for (const auto& trace : (lacks ? real_ : simulated_).traces) here += trace->worth(cause.id);
    }
    there = would_show(other_side, cause, has_it.effects);
  }
  auto evidence = by_losses(here, there, by_law ? double(cause.free_parameters.size()) : 1.0);
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

Weight DifferenceSearch::evidence_of(const CauseType& cause, const Found& real,
                                     const Found& simulated) const {
  if (cause.id == "quantization" || cause.id == "saturation")
    return by_losses(read_off_the_values, read_off_the_values, 1.0);
  if (!has_loss(cause)) return by_errors(real, simulated);
  const auto losses = losses_of(cause, real, simulated);
  return by_losses(losses.real, losses.simulated,
                   static_cast<double>(cause.free_parameters.size()));
}

Losses DifferenceSearch::losses_of(const CauseType& cause, const Found& real,
                                   const Found& simulated) const {
  Losses losses;
  for (const auto& trace : real_.traces)
    losses.real += trace->loss_with(cause.id, simulated.effects);
  for (const auto& trace : simulated_.traces)
    losses.simulated += trace->loss_with(cause.id, real.effects);
  return losses;
}

void DifferenceSearch::compare(const CauseType& cause) {
  const auto real = real_.found(cause.id), simulated = simulated_.found(cause.id);
  if (real.effects.empty() && simulated.effects.empty()) return;
  if (real.effects.empty() || simulated.effects.empty()) {
    one_side_alone(cause, real, simulated);
    return;
  }
  if (!differ_enough(real.effects, simulated.effects)) return;
  const double ratio =
      size_of(cause, real.effects) / std::max(1e-300, size_of(cause, simulated.effects));
  Difference difference{.effect = std::string(cause.id),
                        .how = ratio > 1.0 + least_of_effect   ? Differs::too_little
                               : ratio < 1.0 - least_of_effect ? Differs::too_much
                                                               : Differs::other_form,
                        .real = real.effects,
                        .simulated = simulated.effects,
                        .addition = {}};
  difference.addition.effects = instead_of(cause, real.effects, simulated.effects);
  if (says(cause)) (void)keep(difference, evidence_of(cause, real, simulated));
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
  double loss_real = 0.0, loss_simulated = 0.0;
  for (const auto& trace : real_.traces) loss_real += (*trace.*loss)(simulated);
  for (const auto& trace : simulated_.traces) loss_simulated += (*trace.*loss)(real);
  (void)keep(difference, by_losses(loss_real, loss_simulated, 1.0));
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
