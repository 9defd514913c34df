#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/likelihood/arima_law.hpp>
#include <gyrostat/diagnosis/likelihood/beside_jumps.hpp>
#include <gyrostat/diagnosis/likelihood/block_level.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_names.hpp>
#include <gyrostat/generators/effects/noise_averaging.hpp>
#include <gyrostat/generators/effects/quantization.hpp>

namespace gyrostat::gap {
namespace {

/// Sizes of innovations are odd in more ways than the catalogue has effects for.
constexpr double prior_of_sizes = 4.0;
/// Of noise that is next to nothing beside its rounding, no size is known.
constexpr double most_rounding = 30.0;

/// Whether what is left beside the level of a block has one size: a walk that shows within it is
/// larger at its ends than in its middle.
bool is_of_one_size(const Scenario& scenario, const std::vector<Span>& blocks) {
  const double walk = ArimaLaw::of(scenario.random_error).walk_dps;
  const double white = white_with_rounding(scenario);
  return blocks.empty() ||
         walk * walk * static_cast<double>(blocks.front().size()) / 6.0 < white * white;
}

bool colours_noise(const Scenario& set) {
  return has(set, "noise_bandwidth") || has(set, "noise_averaging");
}

bool is_any(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), char{1}) != flags.end();
}

/// Variance of the error of rounding.
double rounding_of(const Scenario& set) {
  double sum = 0.0;
  for (const auto& effect : set.effects)
    if (const auto* grid = effect.as<effects::Quantization>())
      sum += grid->lsb_dps * grid->lsb_dps / 12.0;
  return sum;
}

}  // namespace

void SetSearcher::judge_tails(const Standing& standing, Past past) {
  auto hidden = edges_of_the_dead_zone(standing.scenario);
  const auto unknown = unknown_samples(standing.scenario);
  const auto beyond = samples_shifted_beyond(conditions_, standing.scenario);
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    hidden[i] |= repeats_[i];
    hidden[i] |= unknown[i];
    hidden[i] |= beyond[i];
  }
  auto left = bench_.rate_left_by(standing.scenario, hidden);
  // Neither may outliers pass for a burst, nor the samples of a burst for outliers.
  const auto bursts_beside = [&](const std::vector<char>& outliers) {
    auto others = left;
    for (std::size_t i = 0; i < outliers.size(); ++i)
      if (outliers[i] != 0) others[i] = no_value;
    return samples_in_bursts(bench_, standing.scenario, others);
  };
  auto bursts = bursts_beside(tails_.outliers);
  if (tails_.outliers.empty() && is_any(bursts))
    bursts =
        bursts_beside(tails_of(conditions_, left, conditions_.has_temperature(), past).outliers);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (bursts[i] != 0) left[i] = no_value;
  // Nor the level on either side of a jump.
  if (law_of(standing.scenario, conditions_.interval_s()).jumps) {
    const auto beside = samples_beside_jumps(left, level_blocks(conditions_));
    for (std::size_t i = 0; i < left.size(); ++i)
      if (beside[i] != 0) left[i] = no_value;
  }
  tails_ = tails_of(conditions_, left, conditions_.has_temperature(), past);
  // The less noise is left beside the set, the more of it goes with the level.
  if (undithered_lsb_dps_ > 0.0)
    feigned_.warmth = feigned_by_grid(undithered_lsb_dps_ / noise_about_levels(left)).warmth;
  const double value = 0.5 * std::log(static_cast<double>(recording_.size()));
  has_outliers_ = bench_.is_allowed("outliers") && !slips(standing.scenario) &&
                  tails_.outlier_gain > prior_of_sizes + 2.0 * value + 4.0 + feigned_.tails;
  has_warm_noise_ = bench_.is_allowed("noise_temperature") &&
                    rounding_over_noise(standing.scenario) < most_rounding &&
                    tails_.temperature_gain > prior_of_sizes + value + feigned_.warmth;
}

void SetSearcher::add_nameless_tails(FoundSet& found) const {
  const double value = 0.5 * std::log(static_cast<double>(recording_.size()));
  const auto add = [&](const std::string& what, double gain, double values) {
    found.unexplained.push_back({what, std::min(1.0, std::exp(values * value - gain))});
  };
  if (!has_outliers_ && !slips(found.scenario))
    add("tails of the noise", tails_.outlier_gain - feigned_.tails, 2.0);
  if (!has_warm_noise_)
    add("noise over temperature", tails_.temperature_gain - feigned_.warmth, 1.0);
}

Standing SetSearcher::searched_beside_tails(Standing standing) {
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    const auto hidden = bench_.masked();
    // At first it is not known what colours the noise.
    const auto past =
        round == 0 || colours_noise(standing.scenario) ? Past::may_be_of_outliers : Past::is_quiet;
    judge_tails(standing, past);
    if (round == 0 && has_outliers_) {
      // What a motion leaves must not pass for outliers.
      const auto all = candidates_;
      std::erase_if(candidates_,
                    [](const auto* cause) { return band_of(cause->id) != EffectBand::motion; });
      standing = searched(std::move(standing));
      candidates_ = all;
      judge_tails(standing, past);
    }
    if (!is_of_one_size(standing.scenario, level_blocks(conditions_))) {
      tails_ = {};
      has_outliers_ = has_warm_noise_ = false;
    }
    // The largest samples would hide what else there is.
    bench_.mask_only(repeats_);
    bench_.mask_too(edges_of_the_dead_zone(standing.scenario));
    if (has_outliers_ && !tails_.innovational) bench_.mask_too(tails_.outliers);
    hidden_from_response_ = bench_.masked();
    bench_.mask_too(unknown_samples(standing.scenario));
    if (round > 0 && bench_.masked() == hidden) break;
    standing = without_wide_lines(coloured_anew(
        responding_without_names(responding_anew(searched(bench_.refitted(standing.scenario))))));
  }
  return standing;
}

double SetSearcher::rounding_over_noise(const Scenario& set) const {
  const double rounding = rounding_of(set);
  if (rounding == 0.0) return 0.0;
  // Of noise that is coloured, an innovation has a part, with all that comes after what colours it.
  const double noise = colours_noise(set) ? std::pow(tails_.deviation, 2) - rounding
                                          : law_of(set, conditions_.interval_s()).white;
  return std::min(most_rounding, rounding / std::max(noise, 1e-300));
}

void SetSearcher::leave_to_tails(const Scenario& set, Arima111<double>& fitted) const {
  double& deviation = fitted.measurement_noise_std_dps;
  if (has(set, "outliers")) deviation *= tails_.quiet;
  if (!has(set, "noise_temperature")) return;
  // The error of rounding stays as it is.
  const double rounding = rounding_over_noise(set);
  const double at_reference = (1.0 + rounding) / tails_.mean_square_of_warmth - rounding;
  deviation *= std::sqrt(std::max(0.0, at_reference));
}

void SetSearcher::add_tails(FoundSet& found) const {
  const auto law = law_of(found.scenario, conditions_.interval_s());
  if (slips(found.scenario))
    for (auto& effect : found.scenario.effects)
      if (effect.id() == "noise_averaging") {
        // Of a clock that is behind neighbours are more alike.
        constexpr double even = 0.25;
        const auto covariance = effect.as<effects::NoiseAveraging>()->autocovariance();
        const bool is_behind = covariance[1] > even * covariance[0];
        effect.value(field_of(effect, "slip")) = is_behind ? -tails_.turns : tails_.turns;
      }
  if (has_outliers_) {
    const bool before = tails_.innovational && colours_noise(found.scenario);
    // Sizes are of innovations, which a filter makes smaller.
    const double scale = before ? tails_.quiet * std::sqrt(law.white) / tails_.deviation : 1.0;
    auto& effects = found.scenario.effects;
    for (auto population : tails_.populations) {
      population.std_dps *= scale;
      population.mean_size_dps *= scale;
      population.before_filter = before ? 1.0 : 0.0;
      effects.insert(before ? effects.begin() : effects.end(), Effect(population));
      if (!before) continue;
      for (auto& interval : found.intervals) ++interval.effect;
    }
    found.members.push_back({"outliers", tails_.outlier_gain - feigned_.tails - 10.0});
  }
  if (has_warm_noise_) {
    // The error of rounding stays as it is.
    const double of_what_warms = 1.0 + rounding_over_noise(found.scenario);
    found.scenario.effects.push_back(with_values(
        "noise_temperature", {{"relative_per_C", tails_.noise_per_C * of_what_warms},
                              {"reference_C", tails_.reference_C},
                              {"curvature_per_C2", tails_.noise_per_C2 * of_what_warms}}));
    found.members.push_back({"noise_temperature", tails_.temperature_gain - feigned_.warmth - 8.0});
  }
  leave_to_tails(found.scenario, found.scenario.random_error);
}

}  // namespace gyrostat::gap
