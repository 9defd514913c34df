#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/evidence.hpp>
#include <gyrostat/diagnosis/likelihood/compass_search.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_shape.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/tails.hpp>

namespace gyrostat::gap {
namespace {

/// Log prior odds against any one effect more: of some thirty one or two are there.
constexpr double prior = 4.0;
/// What a parameter gains by chance: half a nat, and as much again as makes chance rare.
constexpr double of_a_parameter = 1.5;
/// A further effect of the same band gains this share of what the band's clearest does: nature's
/// form of an effect and ours differ by as much.
constexpr double share_of_band = 0.003;
constexpr double most_odds = 1e4;
/// So far behind, polishing may still bring a candidate in front.
constexpr double within_reach_of_polish = 30.0;
constexpr int screening_iterations = 3, fitting_iterations = 15;

bool is_compass(const CauseType& cause) { return cause.effect().stage() == Stage::compass; }
/// Found from the values or the sizes of innovations, and not by the likelihood of the rate.
bool is_marked(std::string_view id, bool saturation) {
  return (saturation && id == "saturation") || id == "quantization" || id == "stale_samples" ||
         id == "outliers" || id == "noise_temperature";
}

/// Where in the rate error an effect shows.
enum class Band { fast, slow, thermal, motion };
Band band_of(std::string_view id) {
  const auto& cause = cause_types().named(id, "effects");
  if (cause.signature == Signature::repeated && id != "sinusoidal") return Band::motion;
  if (cause.signature == Signature::slow) return Band::thermal;
  const auto stage = cause.effect().stage();
  return stage == Stage::noise || id == "vibration" || id == "vibration_bursts" ||
                 id == "wandering_line" || id == "sinusoidal"
             ? Band::fast
             : Band::slow;
}

std::size_t index_of(const Scenario& scenario, std::string_view effect) {
  const auto& all = scenario.effects;
  return static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [&](const auto& e) { return e.id() == effect; }) -
      all.begin());
}
bool has(const Scenario& scenario, std::string_view effect) {
  return index_of(scenario, effect) < scenario.effects.size();
}

/// A sensor has lines as it has them; every other effect is there once.
bool may_repeat(const Scenario& scenario, std::string_view effect) {
  constexpr std::ptrdiff_t most_lines = 3;
  return effect == "vibration" &&
         std::count_if(scenario.effects.begin(), scenario.effects.end(),
                       [&](const auto& e) { return e.id() == effect; }) < most_lines;
}

/// Same in every replica and not slow: taken out of the recording, sample by sample.
bool is_taken_out(const Effect& effect) {
  const auto* cause = cause_types().find(effect.id());
  return cause != nullptr && cause->signature == Signature::repeated &&
         effect.stage() != Stage::compass;
}

/// A set with its fit.
struct Standing {
  Scenario scenario;  ///< every effect but those of the compass
  std::shared_ptr<const SetFitter> fitter;
  SetFit fit;
  double score = -1e300;  ///< log-likelihood less what its parameters cost
};

class Search {
 public:
  Search(const Simulator& simulator, const Series& recording, const SetSearchOptions& options,
         const SetSearchProgress& progress)
      : simulator_(simulator),
        conditions_(simulator.conditions()),
        recording_(recording),
        options_(options),
        progress_(progress) {}

  FoundSet run();
  Scenario likeliest_baseline();
  Scenario subset_of(const Scenario& whole, const std::vector<std::string>& names);

 private:
  const Simulator& simulator_;
  const Conditions& conditions_;
  const Series& recording_;
  SetSearchOptions options_;
  SetSearchProgress progress_;
  std::vector<char> masked_, repeats_, outliers_;
  bool marked_saturation_ = false;
  std::vector<const CauseType*> candidates_;
  mutable std::vector<std::pair<std::string, double>> screening_, gains_;

  void tell(const std::string& what, double share) const {
    if (progress_) progress_(what, share);
  }
  bool is_allowed(std::string_view id) const {
    const auto& without = options_.without;
    if (std::find(without.begin(), without.end(), id) != without.end()) return false;
    const auto* cause = cause_types().find(id);
    return cause != nullptr && cause->why_not_assessable(conditions_).empty();
  }
  Scenario plain() const;
  Standing baseline_fit();
  Series left_by(const Scenario& scenario) const;
  std::shared_ptr<const SetFitter> fitter_of(const Scenario& scenario) const;
  double cost(const Scenario& scenario) const;
  Standing fitted(const Scenario& scenario, std::shared_ptr<const SetFitter> fitter, int iterations,
                  Jumping jumping = Jumping::yes) const;
  Standing refitted(const Scenario& scenario, int iterations = fitting_iterations) const {
    return fitted(scenario, fitter_of(scenario), iterations);
  }
  /// With one more effect; a score of -1e300 where it cannot be had.
  Standing with(const Standing& standing, const CauseType& cause, const Evidence* left) const;
  Standing polished(Standing standing) const;
  Standing without(const Standing& standing, std::size_t effect) const;
  void name_lines(FoundSet& found) const;
  std::vector<double> rate_left_by(const Scenario& scenario) const;
  std::vector<Standing> each_added(const Standing& standing, std::string_view barred = {}) const;
  Standing searched(Standing standing) const;
  double least_gain(const Standing& standing, const Standing& next) const;
  Evidence evidence_of(const Standing& standing) const;
};

Scenario Search::plain() const {
  Scenario s;
  s.sampling.duration_s = conditions_.interval_s() * static_cast<double>(conditions_.size());
  s.sampling.rate_hz = conditions_.rate_hz();
  s.random_error = {
      .phi = 0.0, .delta1_dps = 0.0, .delta2_dps = 0.0, .measurement_noise_std_dps = 0.0};
  s.thermal_drift = {.a_dps_per_C = 0.0, .b_dps_s_per_C = 0.0, .c_dps = 0.0};
  s.compass.noise_std_deg = 0.0;
  return s;
}

/// The recording without what is the same in every replica of the scenario.
Series Search::left_by(const Scenario& scenario) const {
  Series left = recording_;
  Scenario quiet = plain();
  for (const auto& effect : scenario.effects)
    if (is_taken_out(effect)) quiet.effects.push_back(effect);
  if (quiet.effects.empty()) return left;
  Series with, bare;
  synthesise_rate_under(quiet, conditions_.series(), {}, with);
  quiet.effects.clear();
  synthesise_rate_under(quiet, conditions_.series(), {}, bare);
  for (std::size_t i = 0; i < left.size(); ++i)
    left.gyro_dps[i] -= with.gyro_dps[i] - bare.gyro_dps[i];
  return left;
}

std::shared_ptr<const SetFitter> Search::fitter_of(const Scenario& scenario) const {
  auto error = left_by(scenario).gyro_dps;
  const auto& reference = conditions_.series().rate_ref_dps;
  for (std::size_t i = 0; i < reference.size(); ++i) error[i] -= reference[i];
  conditions_.bridge(error);
  return std::make_shared<SetFitter>(
      conditions_, std::make_shared<const ReducedRate>(conditions_, error, masked_));
}

/// So much for each parameter that is fitted, and the logarithm of the places looked at for lines.
double Search::cost(const Scenario& scenario) const {
  const double values = static_cast<double>(conditions_.train_points().size());
  double sum = 0.0;
  for (const auto& effect : scenario.effects) {
    const auto* cause = cause_types().find(effect.id());
    if (cause == nullptr || is_marked(effect.id(), marked_saturation_)) continue;
    sum += prior +
           of_a_parameter * static_cast<double>(cause->free_parameters.size() - cause->amplitudes +
                                                (effect.id() == "noise_bandwidth" ? 1 : 0));
    if (effect.id() == "sinusoidal") sum += std::log(static_cast<double>(conditions_.size()));
    if (effect.id() == "vibration") sum += 0.5 * std::log(values);
  }
  return sum;
}

Standing Search::fitted(const Scenario& scenario, std::shared_ptr<const SetFitter> fitter,
                        int iterations, Jumping jumping) const {
  Standing s{
      .scenario = {}, .fitter = fitter, .fit = fitter->maximise(scenario, iterations, jumping)};
  s.scenario = s.fit.scenario;
  s.score = s.fit.log_likelihood - cost(s.scenario);
  for (const auto& effect : s.scenario.effects)
    if (const auto* cause = cause_types().find(effect.id());
        cause != nullptr && !cause->is_what_it_is_called(effect, conditions_))
      s.score = -1e300;
  return s;
}

Evidence Search::evidence_of(const Standing& standing) const {
  const Series left = left_by(standing.scenario);
  Evidence evidence{simulator_, recording_, Scene(conditions_, left), standing.scenario};
  evidence.baseline.effects.clear();
  return evidence;
}

Standing Search::with(const Standing& standing, const CauseType& cause,
                      const Evidence* left) const {
  Standing best;
  const auto keep = [&](Standing candidate) {
    if (candidate.score > best.score) best = std::move(candidate);
  };
  if (cause.guesses != nullptr) {
    const Beside beside{conditions_, *standing.fitter, standing.fit};
    for (const auto& guess : cause.guesses(beside))
      for (const double walk : {1.0, 0.1}) {
        Scenario scenario = standing.scenario;
        scenario.random_error.delta1_dps *= walk;
        scenario.effects.push_back(guess);
        keep(fitted(scenario, standing.fitter, screening_iterations, Jumping::no));
      }
    if (best.score < -1e299) return best;
    return fitted(best.scenario, best.fitter, fitting_iterations);
  }
  if (left == nullptr || !is_taken_out(cause.effect())) return best;
  for (const auto& start : cause.starts(*left)) {
    Scenario scenario = standing.scenario;
    scenario.effects.push_back(start);
    keep(refitted(scenario, 6));
  }
  if (best.score > standing.score - within_reach_of_polish) keep(polished(best));
  return best;
}

/// The parameters of what is taken out, each by parabolas through the likelihood, the noise as it
/// is.
Standing Search::polished(Standing standing) const {
  const auto likelihood = [&](const Scenario& scenario) {
    return fitter_of(scenario)->terms(scenario, Part::train).log_likelihood;
  };
  Scenario scenario = standing.scenario;
  double here = likelihood(scenario);
  for (int pass = 0; pass < 2; ++pass)
    for (auto& effect : scenario.effects) {
      if (!is_taken_out(effect)) continue;
      const auto& cause = cause_types().named(effect.id(), "effects");
      for (const auto name : cause.free_parameters) {
        const auto f = field_of(effect, name);
        const double middle = effect.value(f);
        double step = (pass == 0 ? 0.02 : 0.004) * std::max(std::abs(middle), 1e-9);
        effect.value(f) = middle + step;
        const double above = likelihood(scenario);
        effect.value(f) = middle - step;
        const double below = likelihood(scenario);
        const double curve = above + below - 2.0 * here;
        double by =
            curve < 0.0 ? 0.5 * step * (below - above) / curve : (above > below ? step : -step);
        by = std::clamp(by, -5.0 * step, 5.0 * step);
        const auto& range = effect.fields()[f].range;
        effect.value(f) = std::clamp(middle + by, range.from, range.to);
        const double there = likelihood(scenario);
        if (there > here)
          here = there;
        else
          effect.value(f) = middle;
      }
    }
  return refitted(scenario, 8);
}

Standing Search::without(const Standing& standing, std::size_t effect) const {
  Scenario rest = standing.scenario;
  rest.effects.erase(rest.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  // What the walk must stand in for has to begin where it can be seen.
  auto& walk = rest.random_error.delta1_dps;
  const Beside beside{conditions_, *standing.fitter, standing.fit};
  const double small =
      0.1 * beside.slow_std_dps() / std::sqrt(static_cast<double>(conditions_.cluster()));
  Standing best = refitted(rest);
  if (walk < small) {
    walk = small;
    if (auto other = refitted(rest); other.score > best.score) best = std::move(other);
  }
  return best;
}

std::vector<Standing> Search::each_added(const Standing& standing, std::string_view barred) const {
  std::vector<Standing> all(candidates_.size());
  std::optional<Evidence> left;
  if (std::any_of(candidates_.begin(), candidates_.end(),
                  [](const auto* cause) { return cause->guesses == nullptr; }))
    left.emplace(evidence_of(standing));
  tbb::parallel_for(
      std::size_t{0}, candidates_.size(),
      [&](std::size_t k) {
        const auto& cause = *candidates_[k];
        if ((!has(standing.scenario, cause.id) || may_repeat(standing.scenario, cause.id)) &&
            cause.id != barred)
          all[k] = with(standing, cause, left ? &*left : nullptr);
      },
      tbb::simple_partitioner());
  return all;
}

double Search::least_gain(const Standing& standing, const Standing& next) const {
  const auto band = band_of(next.scenario.effects.back().id());
  double most = 0.0;
  for (const auto& [effect, gain] : gains_)
    if (has(standing.scenario, effect) &&
        (band_of(effect) == band || band_of(effect) == Band::motion))
      most = std::max(most, gain);
  return share_of_band * most;
}

Standing Search::searched(Standing standing) const {
  for (std::size_t step = 0; step < 2 * options_.most_effects; ++step) {
    if (standing.scenario.effects.size() >= options_.most_effects + 2) break;
    auto tried = each_added(standing);
    const auto best = std::max_element(
        tried.begin(), tried.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    for (const auto& t : tried)
      if (t.score > -1e299)
        screening_.emplace_back(t.scenario.effects.back().id(), t.score - standing.score);
    if (best == tried.end() || best->score <= standing.score + least_gain(standing, *best)) break;
    gains_.emplace_back(best->scenario.effects.back().id(), best->score - standing.score);
    standing = *best;
    tell(fmt::format("adding {}", standing.scenario.effects.back().id()),
         0.1 + 0.1 * static_cast<double>(step));
    // What the newcomer made needless goes.
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
        if (is_marked(standing.scenario.effects[k].id(), marked_saturation_)) continue;
        auto rest = without(standing, k);
        if (rest.score > standing.score) {
          standing = std::move(rest);
          dropped = true;
          break;
        }
      }
    }
  }
  return standing;
}

/// Narrow bands have the names that their envelopes say.
void Search::name_lines(FoundSet& found) const {
  constexpr double clear = 4.0;
  for (auto& effect : found.scenario.effects) {
    if (effect.id() != "vibration") continue;
    const double std_dps = effect.value(field_of(effect, "std_dps"));
    const double centre_hz = effect.value(field_of(effect, "centre_hz"));
    const double bandwidth_hz = effect.value(field_of(effect, "bandwidth_hz"));
    const auto left = rate_left_by(found.scenario);
    const auto shape = line_shape(conditions_, left, {std_dps * std_dps, centre_hz, bandwidth_hz});
    const bool bursts = shape.bursts > shape.wandering;
    const double gain = std::max(shape.bursts, shape.wandering);
    const std::string_view name = bursts ? "vibration_bursts" : "wandering_line";
    if (gain < clear) continue;
    const auto known = std::find_if(found.members.begin(), found.members.end(),
                                    [](const auto& m) { return m.effect == "vibration"; });
    if (!is_allowed(name)) {
      if (known != found.members.end()) known->log_odds = -gain;
      continue;
    }
    if (bursts)
      effect = with_values("vibration_bursts", {{"std_dps", shape.on_std_dps},
                                                {"centre_hz", centre_hz},
                                                {"bandwidth_hz", bandwidth_hz},
                                                {"mean_duration_s", shape.on_s},
                                                {"mean_interval_s", shape.off_s}});
    else
      effect = with_values("wandering_line", {{"amplitude_dps", std::sqrt(2.0) * std_dps},
                                              {"frequency_hz", centre_hz},
                                              {"wander_hz", 0.5 * bandwidth_hz},
                                              {"correlation_time_s", 1.0 / bandwidth_hz}});
    if (known != found.members.end()) {
      known->effect = name;
      known->log_odds = std::min(known->log_odds, gain);
    }
  }
  // One name each, however many lines it has.
  auto& members = found.members;
  for (std::size_t k = 1; k < members.size();)
    if (std::any_of(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const auto& m) { return m.effect == members[k].effect; }))
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(k));
    else
      ++k;
  for (const auto& effect : found.scenario.effects)
    if (std::none_of(members.begin(), members.end(),
                     [&](const auto& m) { return m.effect == effect.id(); }))
      members.push_back({std::string(effect.id()), clear});
}

/// The rate error less what is taken out, without repeats.
std::vector<double> Search::rate_left_by(const Scenario& scenario) const {
  auto left = left_by(scenario).gyro_dps;
  const auto& reference = conditions_.series().rate_ref_dps;
  for (std::size_t i = 0; i < reference.size(); ++i) left[i] -= reference[i];
  conditions_.bridge(left);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (repeats_[i] != 0 || (has(scenario, "outliers") && outliers_[i] != 0)) left[i] = no_value;
  // Without its level, taken over long enough not to follow single samples, and within one part.
  const std::size_t block = std::max<std::size_t>(conditions_.cluster(), 32);
  for (const Part part : parts)
    for (const auto& span : conditions_.spans(part))
      for (std::size_t first = span.first; first < span.last; first += block) {
        const std::size_t last = std::min(first + block, span.last);
        double sum = 0.0, count = 0.0;
        for (std::size_t i = first; i < last; ++i)
          if (!is_missing(left[i])) sum += left[i], count += 1.0;
        for (std::size_t i = first; i < last; ++i) left[i] -= count > 0.0 ? sum / count : 0.0;
      }
  return left;
}

/// Nothing masked, no effects.
Standing Search::baseline_fit() {
  masked_.assign(recording_.size(), 0);
  Scenario base = plain();
  const Scene scene(conditions_, recording_, train_alone);
  const double first =
      scene.octaves[0].empty() ? 1.0 : std::sqrt(0.5 * scene.octaves[0][0].mean_square);
  base.random_error.measurement_noise_std_dps = std::max(first, 1e-9);
  base.random_error.delta1_dps = 0.03 * base.random_error.measurement_noise_std_dps /
                                 std::sqrt(static_cast<double>(conditions_.cluster()));
  return refitted(base);
}

Scenario Search::subset_of(const Scenario& whole, const std::vector<std::string>& names) {
  const auto is_in = [&](std::string_view id) {
    return std::find(names.begin(), names.end(), id) != names.end();
  };
  masked_ = repeats_;
  if (!is_in("stale_samples") && !is_in("saturation"))
    std::fill(masked_.begin(), masked_.end(), char{0});
  if (is_in("outliers"))
    for (std::size_t i = 0; i < masked_.size(); ++i)
      if (outliers_[i] != 0) masked_[i] = 1;
  Scenario some = whole;
  some.effects.clear();
  for (const auto& effect : whole.effects)
    if (is_in(effect.id())) some.effects.push_back(effect);
  Scenario rate = some;
  std::erase_if(rate.effects, [](const auto& e) { return e.stage() == Stage::compass; });
  auto& walk = rate.random_error.delta1_dps;
  walk = std::max(walk, 0.03 * rate.random_error.measurement_noise_std_dps /
                            std::sqrt(static_cast<double>(conditions_.cluster())));
  const auto fit = refitted(rate, 8);
  some.random_error = fit.scenario.random_error;
  return some;
}

Scenario Search::likeliest_baseline() {
  FoundSet found{.baseline = baseline_fit().scenario, .scenario = plain()};
  if (conditions_.has_heading()) search_compass(simulator_, recording_, options_, found);
  return found.baseline;
}

FoundSet Search::run() {
  FoundSet found;
  tell("reading values", 0.02);
  const auto marks = marks_of(simulator_, recording_);
  masked_.assign(recording_.size(), 0);
  const bool clipped = marks.limit_dps > 0.0 && is_allowed("saturation");
  const bool stale = marks.stale_probability > 0.0 && is_allowed("stale_samples");
  const auto mask = [&](const std::vector<char>& more) {
    for (std::size_t i = 0; i < masked_.size(); ++i)
      if (more[i] != 0) masked_[i] = 1;
  };
  if (stale) mask(marks.repeats);
  if (clipped) {
    // Near the limit, noise decides what is clipped: what is left of it is no longer centred.
    auto near = marks.clipped;
    const auto& reference = conditions_.series().rate_ref_dps;
    constexpr std::size_t reach = 5;
    for (std::size_t i = 0; i < near.size(); ++i) {
      const std::size_t from = i < reach ? 0 : i - reach;
      const std::size_t to = std::min(i + reach + 1, near.size());
      if (std::abs(reference[i]) > 0.97 * marks.limit_dps ||
          std::any_of(marks.clipped.begin() + static_cast<std::ptrdiff_t>(from),
                      marks.clipped.begin() + static_cast<std::ptrdiff_t>(to),
                      [](char c) { return c != 0; }))
        near[i] = 1;
    }
    mask(near);
  }
  repeats_ = masked_;
  const std::vector<char> unmasked(recording_.size(), 0);
  masked_ = unmasked;
  for (const auto& cause : cause_types())
    if (is_allowed(cause.id) && !is_compass(cause) && !is_marked(cause.id, false))
      candidates_.push_back(&cause);

  tell("fitting the baseline", 0.05);
  const auto baseline = baseline_fit();
  masked_ = repeats_;
  found.baseline = baseline.scenario;

  // Rounding to more than the noise is no longer noise: what it does to the fast part and to slow
  // noise has no law here.
  constexpr double coarsest = 2.2;
  const bool coarse =
      marks.lsb_dps > coarsest * baseline.scenario.random_error.measurement_noise_std_dps;
  // Rounded to nearly as much, samples are no longer normal: their tails say nothing.
  const bool is_normal =
      marks.lsb_dps < 1.2 * baseline.scenario.random_error.measurement_noise_std_dps;
  if (coarse)
    std::erase_if(candidates_, [](const auto* cause) {
      const auto band = band_of(cause->id);
      return band == Band::fast || band == Band::slow;
    });

  Scenario start = baseline.scenario;
  const auto mark = [&](const Effect& effect, double log_odds) {
    start.effects.push_back(effect);
    found.members.push_back({std::string(effect.id()), log_odds});
  };
  if (marks.lsb_dps > 0.0 && is_allowed("quantization"))
    mark(with_values("quantization", {{"lsb_dps", marks.lsb_dps}}), 50.0);
  if (stale)
    mark(with_values("stale_samples",
                     {{"probability", marks.stale_probability}, {"mean_run", marks.stale_run}}),
         50.0);

  if (clipped) mark(with_values("saturation", {{"limit_dps", marks.limit_dps}}), 50.0);
  marked_saturation_ = clipped;

  Standing standing = refitted(start);
  Tails tails;
  bool outliers = false, warm = false;
  for (int round = 0; round < 2; ++round) {
    const auto hidden = masked_;
    // The largest samples would hide what else there is.
    const auto left = rate_left_by(standing.scenario);
    tails = tails_of(conditions_, left, is_allowed("noise_temperature"));
    const double values = 0.5 * std::log(static_cast<double>(recording_.size()));
    outliers =
        is_normal && is_allowed("outliers") && tails.outlier_gain > prior + 2.0 * values + 4.0;
    warm = is_allowed("noise_temperature") && tails.temperature_gain > prior + values;
    masked_ = repeats_;
    if (outliers) mask(tails.outliers);
    if (round > 0 && masked_ == hidden) break;
    standing = searched(refitted(standing.scenario));
  }
  tell("trying rivals", 0.7);
  // Each member against all that might stand in its place.
  std::size_t exchanges = 0;
  for (bool swapped = true; swapped;) {
    swapped = false;
    found.rivals.clear();
    for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
      const Effect effect = standing.scenario.effects[k];
      if (is_marked(effect.id(), marked_saturation_)) continue;
      const auto rest = without(standing, k);
      const auto others = each_added(rest, effect.id());
      double second = rest.score;
      const Standing* best = nullptr;
      for (const auto& other : others)
        if (other.score > second) {
          second = other.score;
          best = &other;
        }
      for (const auto& other : others)
        if (other.score > standing.score - 3.0)
          found.rivals.push_back({other.scenario.effects.back(),
                                  std::string(other.scenario.effects.back().id()),
                                  std::string(effect.id()), other.score - standing.score});
      if (second > standing.score + 0.1) {
        standing = searched(best != nullptr ? *best : rest);
        swapped = ++exchanges < 2 * options_.most_effects;
        break;
      }
      const auto known = std::find_if(found.members.begin(), found.members.end(),
                                      [&](const auto& m) { return m.effect == effect.id(); });
      const double odds = std::min(standing.score - second, most_odds);
      if (known == found.members.end())
        found.members.push_back({std::string(effect.id()), odds});
      else
        known->log_odds = std::max(known->log_odds, odds);
    }
    if (swapped)
      found.members.erase(
          std::remove_if(found.members.begin(), found.members.end(),
                         [&](const auto& m) { return !is_marked(m.effect, marked_saturation_); }),
          found.members.end());
  }
  found.screening = screening_;
  found.scenario = standing.scenario;
  outliers_ = tails.outliers;
  if (outliers) {
    found.scenario.effects.push_back(with_values(
        "outliers",
        {{"probability", tails.outlier_probability}, {"std_dps", tails.outlier_std_dps}}));
    found.members.push_back({"outliers", tails.outlier_gain - 10.0});
  }
  if (warm) {
    found.scenario.effects.push_back(
        with_values("noise_temperature",
                    {{"relative_per_C", tails.noise_per_C}, {"reference_C", tails.reference_C}}));
    found.members.push_back({"noise_temperature", tails.temperature_gain - 8.0});
  }
  name_lines(found);
  if (coarse) found.scenario.random_error.measurement_noise_std_dps = marks.white_under_grid_dps;
  auto& drift = found.scenario.thermal_drift;
  const auto& coefficients = standing.fit.drift;
  drift = {.a_dps_per_C = coefficients.size() > 0 ? coefficients[0] : 0.0,
           .b_dps_s_per_C = coefficients.size() > 1 ? coefficients[1] : 0.0,
           .c_dps = 0.0};
  if (conditions_.has_heading()) search_compass(simulator_, recording_, options_, found);
  return found;
}

}  // namespace

Scenario likeliest_baseline(const Simulator& simulator, const Series& recording) {
  SetSearchOptions nothing;
  for (const auto& cause : cause_types()) nothing.without.emplace_back(cause.id);
  return Search(simulator, recording, nothing, {}).likeliest_baseline();
}

FoundSet find_set(const Simulator& simulator, const Series& recording,
                  const SetSearchOptions& options, const SetSearchProgress& progress) {
  const auto search = std::make_shared<Search>(simulator, recording, options, progress);
  auto found = search->run();
  found.subset = [search, whole = found.scenario](const std::vector<std::string>& names) {
    return search->subset_of(whole, names);
  };
  return found;
}

}  // namespace gyrostat::gap
