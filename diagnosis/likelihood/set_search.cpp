#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/compass_search.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_names.hpp>
#include <gyrostat/diagnosis/likelihood/marks.hpp>
#include <gyrostat/diagnosis/likelihood/motion_left.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>
#include <gyrostat/diagnosis/likelihood/tails.hpp>

namespace gyrostat::gap {
namespace {

/// A further effect of the same band gains this share of what the band's clearest does: nature's
/// form of an effect and ours differ by as much.
constexpr double share_of_band = 0.003;
constexpr double most_odds = 1e4;
/// Sizes of innovations are odd in more ways than the catalogue has effects for.
constexpr double prior_of_sizes = 4.0;
bool is_compass(const CauseType& cause) { return cause.effect().stage() == Stage::compass; }
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

Band band_of_last(const Standing& standing) {
  return band_of(standing.scenario.effects.back().id());
}

bool is_slow(std::string_view id) {
  const auto band = band_of(id);
  return band == Band::slow || band == Band::thermal;
}

void add_mark(std::string_view effect, FoundSet& found) {
  constexpr double odds_of_a_mark = 50.0;
  found.members.push_back({std::string(effect), odds_of_a_mark, true});
}

/// Standard deviation of white noise with what rounding adds.
double white_with_rounding(const Scenario& scenario) {
  const auto law = law_of(scenario, 1.0);
  return std::sqrt(law.white + law.rounding);
}

/// A sensor has lines as it has them; every other effect is there once.
bool may_repeat(const Scenario& scenario, std::string_view effect) {
  constexpr std::ptrdiff_t most_lines = 3;
  return effect == "vibration" &&
         std::count_if(scenario.effects.begin(), scenario.effects.end(),
                       [&](const auto& e) { return e.id() == effect; }) < most_lines;
}

class Search {
 public:
  Search(const Simulator& simulator, const Series& recording, const SetSearchOptions& options,
         const SetSearchProgress& progress)
      : simulator_(simulator),
        conditions_(simulator.conditions()),
        recording_(recording),
        options_(options),
        progress_(progress),
        bench_(simulator, recording, options.without) {}

  FoundSet run();
  Scenario likeliest_baseline();
  Scenario subset_of(const Scenario& whole, const std::vector<std::string>& names);
  std::vector<Nameless> nameless_beside(const Scenario& set) const;

 private:
  /// `left` rounds are to come at least, as far as is known.
  void tell(const std::string& what, std::size_t left) {
    doing_ = what;
    left_ = left;
    tell_share(0.0);
  }
  /// So much of a round is done.
  void tell_share(double of_round) const {
    const auto rounds = static_cast<double>(rounds_);
    if (progress_) progress_(doing_, (rounds + of_round) / (rounds + static_cast<double>(left_)));
  }
  /// One round of the search.
  std::vector<Standing> each_added(const Standing& standing);
  Standing searched(Standing standing);
  /// The best of the sets with two more effects, neither of which pays alone: where both are slow,
  /// one leaves to the walk what hides it. The standing itself where there is none better.
  Standing two_further(const Standing& standing, std::vector<Standing> tried);
  /// Of a further effect of the band.
  double least_gain(const Standing& standing, Band band) const;
  /// Every member against all that might stand in its place.
  Standing exchanged(Standing standing, FoundSet& found);
  /// With an ARIMA(1,1,1) that remembers, beside what is there or in place of what colours the
  /// noise.
  Standing beside_memory(const Standing& standing) const;
  /// Samples within reach of the limit: there noise decides what is clipped, and what is left of it
  /// is no longer centred.
  std::vector<char> near_the_limit(const Marks& marks) const;
  /// Effects that are read off the values.
  std::vector<Effect> read_off(const Marks& marks, FoundSet& found);
  std::vector<char> edges_of_the_dead_zone(const Scenario& scenario) const;
  /// What the innovations say of outliers and of noise over temperature, beside the set.
  void judge_tails(const Standing& standing);
  void add_tails(FoundSet& found) const;
  void add_nameless_tails(FoundSet& found) const;
  /// The set, and what only the sizes of innovations say, in turn.
  Standing searched_beside_tails(Standing standing);

  const Simulator& simulator_;
  const Conditions& conditions_;
  const Series& recording_;
  SetSearchOptions options_;
  SetSearchProgress progress_;
  SetBench bench_;
  std::vector<char> repeats_;  ///< samples that do not count, whatever the set
  Tails tails_;
  bool is_normal_ = true;  ///< rounded finely enough for tails
  bool is_even_ = true;    ///< rounded finely enough for its size not to depend on the level
  bool has_outliers_ = false, has_warm_noise_ = false;
  std::vector<const CauseType*> candidates_;
  std::size_t rounds_ = 0;  ///< in which every candidate was tried
  std::size_t left_ = 1;
  std::string doing_;
  std::optional<Standing> end_;  ///< of the search; none where the fast part has no law
  std::vector<std::pair<std::string, double>> screening_, gains_;
};

std::vector<Standing> Search::each_added(const Standing& standing) {
  std::vector<Standing> all(candidates_.size());
  std::atomic<std::size_t> tried{0};
  const auto caller = std::this_thread::get_id();
  const auto try_those = [&](bool with_guesses, const Evidence* left) {
    tbb::parallel_for(
        std::size_t{0}, candidates_.size(),
        [&](std::size_t k) {
          const auto& cause = *candidates_[k];
          if ((cause.guesses != nullptr) != with_guesses) return;
          if (!has(standing.scenario, cause.id) || may_repeat(standing.scenario, cause.id))
            all[k] = bench_.with(standing, cause, left);
          const auto done = static_cast<double>(++tried);
          if (std::this_thread::get_id() == caller)
            tell_share(done / static_cast<double>(candidates_.size()));
        },
        tbb::simple_partitioner());
  };
  // Guesses need no evidence, and are tried while it is made for the others.
  tbb::parallel_invoke(
      [&] {
        if (std::all_of(candidates_.begin(), candidates_.end(),
                        [](const auto* cause) { return cause->guesses != nullptr; }))
          return;
        const auto left = bench_.evidence_of(standing);
        try_those(false, &left);
      },
      [&] { try_those(true, nullptr); });
  ++rounds_;
  return all;
}

double Search::least_gain(const Standing& standing, Band band) const {
  double of_band = 0.0, of_motion = 0.0;
  for (const auto& [effect, gain] : gains_) {
    if (!has(standing.scenario, effect)) continue;
    auto& most = band_of(effect) == Band::motion ? of_motion : of_band;
    if (band_of(effect) == band || band_of(effect) == Band::motion) most = std::max(most, gain);
  }
  // Where nothing of the motion is left, its effects have nature's form.
  if (band != Band::motion && of_motion > of_band)
    of_motion = std::min(
        of_motion,
        std::max(0.0, log_gain_of_motion(conditions_,
                                         bench_.rate_left_by(standing.scenario, bench_.masked()))) /
            share_of_band);
  return share_of_band * std::max(of_band, of_motion);
}

Standing Search::two_further(const Standing& standing, std::vector<Standing> tried) {
  constexpr double nearly_pays = 6.0;
  constexpr std::size_t most_tried = 3;
  std::erase_if(tried, [&](const Standing& t) {
    return t.score < standing.score - nearly_pays || !is_slow(t.scenario.effects.back().id());
  });
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  if (tried.size() > most_tried) tried.resize(most_tried);
  const auto all = candidates_;
  std::erase_if(candidates_, [](const auto* cause) { return !is_slow(cause->id); });
  Standing best = standing;
  for (const auto& t : tried)
    for (auto& further : each_added(t))
      if (further.score > best.score &&
          further.score > standing.score + least_gain(t, band_of_last(further)))
        best = std::move(further);
  candidates_ = all;
  return best;
}

Standing Search::searched(Standing standing) {
  for (std::size_t step = 0; step < 2 * options_.most_effects; ++step) {
    if (standing.scenario.effects.size() >= options_.most_effects + 2) break;
    auto tried = each_added(standing);
    const auto best = std::max_element(
        tried.begin(), tried.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
    for (const auto& t : tried)
      if (t.score > -1e299)
        screening_.emplace_back(t.scenario.effects.back().id(), t.score - standing.score);
    if (best == tried.end() || best->score < -1e299) break;
    const bool pays = best->score > standing.score + least_gain(standing, band_of_last(*best));
    auto next = pays ? *best : two_further(standing, std::move(tried));
    if (next.score <= standing.score) break;
    gains_.emplace_back(next.scenario.effects.back().id(), next.score - standing.score);
    standing = std::move(next);
    tell(fmt::format("beside {}", standing.scenario.effects.back().id()),
         standing.scenario.effects.size() + 2);
    // What the newcomer made needless goes.
    for (bool dropped = true; dropped;) {
      dropped = false;
      for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
        if (bench_.is_marked(standing.scenario.effects[k].id())) continue;
        auto rest = bench_.without(standing, k);
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

Standing Search::exchanged(Standing standing, FoundSet& found) {
  std::size_t exchanges = 0;
  for (bool swapped = true; swapped;) {
    swapped = false;
    found.rivals.clear();
    for (std::size_t k = 0; k < standing.scenario.effects.size(); ++k) {
      const Effect effect = standing.scenario.effects[k];
      if (bench_.is_marked(effect.id())) continue;
      tell(fmt::format("rivals of {}", effect.id()), standing.scenario.effects.size() - k);
      const auto rest = bench_.without(standing, k);
      // The same effect from other parameters may stand there, too, but is no rival.
      const auto others = each_added(rest);
      double second = rest.score;
      const Standing* best = &rest;
      for (const auto& other : others) {
        if (other.score > best->score) best = &other;
        if (other.score < -1e299 || other.scenario.effects.back().id() == effect.id()) continue;
        second = std::max(second, other.score);
        if (other.score > standing.score - 3.0)
          found.rivals.push_back({other.scenario.effects.back(),
                                  std::string(other.scenario.effects.back().id()),
                                  std::string(effect.id()), other.score - standing.score});
      }
      if (best->score > standing.score + 0.1) {
        standing = searched(*best);
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
                         [&](const auto& m) { return !bench_.is_marked(m.effect); }),
          found.members.end());
  }
  return standing;
}

Scenario Search::subset_of(const Scenario& whole, const std::vector<std::string>& names) {
  const auto is_in = [&](std::string_view id) {
    return std::find(names.begin(), names.end(), id) != names.end();
  };
  const bool repeats = is_in("stale_samples") || is_in("saturation");
  bench_.mask_only(repeats ? repeats_ : std::vector<char>(recording_.size(), 0));
  if (is_in("outliers")) bench_.mask_too(tails_.outliers);
  Scenario some = whole;
  some.effects.clear();
  for (const auto& effect : whole.effects)
    if (is_in(effect.id())) some.effects.push_back(effect);
  bench_.mask_too(edges_of_the_dead_zone(some));
  Scenario rate = some;
  std::erase_if(rate.effects, [](const auto& e) { return e.stage() == Stage::compass; });
  rate = with_walk_of_at_least(std::move(rate),
                               0.03 * rate.random_error.measurement_noise_std_dps /
                                   std::sqrt(static_cast<double>(conditions_.cluster())));
  auto fit = bench_.refitted(rate, 8);
  if (auto other = bench_.beside_noise(rate.effects); other.score > fit.score)
    fit = std::move(other);
  some.random_error = fit.scenario.random_error;
  return some;
}

std::vector<Nameless> Search::nameless_beside(const Scenario& set) const {
  if (!end_) return {};
  return nameless_parts(simulator_, recording_, *end_->fitter, end_->scenario, set);
}

Scenario Search::likeliest_baseline() {
  FoundSet found{.baseline = bench_.beside_noise({}).scenario, .scenario = bench_.plain()};
  if (conditions_.has_heading()) search_compass(simulator_, recording_, options_, found);
  return found.baseline;
}

Standing Search::beside_memory(const Standing& standing) const {
  if (standing.scenario.random_error.phi != 0.0) return {};
  Standing best = bench_.beside_memory(standing);
  Scenario plain = standing.scenario;
  std::erase_if(plain.effects, [&](const auto& effect) {
    return !bench_.is_marked(effect.id()) && band_of(effect.id()) == Band::fast;
  });
  if (plain.effects.size() < standing.scenario.effects.size())
    if (auto other = bench_.beside_memory(bench_.refitted(plain)); other.score > best.score)
      best = std::move(other);
  return best;
}

std::vector<char> Search::near_the_limit(const Marks& marks) const {
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
  return near;
}

std::vector<Effect> Search::read_off(const Marks& marks, FoundSet& found) {
  std::vector<Effect> effects;
  const auto add = [&](Effect effect) {
    add_mark(effect.id(), found);
    effects.push_back(std::move(effect));
  };
  if (marks.lsb_dps > 0.0 && bench_.is_allowed("quantization"))
    add(with_values("quantization", {{"lsb_dps", marks.lsb_dps}}));
  if (marks.stale_probability > 0.0 && bench_.is_allowed("stale_samples")) {
    add(with_values("stale_samples",
                    {{"probability", marks.stale_probability}, {"mean_run", marks.stale_run}}));
    bench_.mask_too(marks.repeats);
  }
  if (marks.limit_dps > 0.0 && bench_.is_allowed("saturation")) {
    add(with_values("saturation", {{"limit_dps", marks.limit_dps}}));
    bench_.mark_saturation();
    bench_.mask_too(near_the_limit(marks));
  }
  repeats_ = bench_.masked();
  return effects;
}

/// There noise decides whether a sample is written as 0.
std::vector<char> Search::edges_of_the_dead_zone(const Scenario& scenario) const {
  constexpr double reach = 5.0;  // standard deviations
  const auto& reference = conditions_.series().rate_ref_dps;
  std::vector<char> edges(recording_.size(), 0);
  for (const auto& effect : scenario.effects) {
    if (effect.id() != "dead_zone" || reference.empty()) continue;
    const double edge = effect.value(field_of(effect, "half_width_dps"));
    const double near = reach * white_with_rounding(scenario);
    for (std::size_t i = 0; i < edges.size(); ++i)
      edges[i] = std::abs(std::abs(reference[i]) - edge) < near ? 1 : 0;
  }
  return edges;
}

void Search::judge_tails(const Standing& standing) {
  auto hidden = edges_of_the_dead_zone(standing.scenario);
  for (std::size_t i = 0; i < hidden.size(); ++i) hidden[i] |= repeats_[i];
  auto left = bench_.rate_left_by(standing.scenario, hidden);
  // Neither may outliers pass for a burst, nor the samples of a burst for outliers.
  auto without_outliers = left;
  for (std::size_t i = 0; i < tails_.outliers.size(); ++i)
    if (tails_.outliers[i] != 0) without_outliers[i] = no_value;
  const auto bursts = samples_in_bursts(bench_, standing.scenario, without_outliers);
  for (std::size_t i = 0; i < left.size(); ++i)
    if (bursts[i] != 0) left[i] = no_value;
  // Nor the level on either side of a jump.
  if (law_of(standing.scenario, conditions_.interval_s()).jumps) {
    const auto beside = samples_beside_jumps(left, bench_.level_blocks());
    for (std::size_t i = 0; i < left.size(); ++i)
      if (beside[i] != 0) left[i] = no_value;
  }
  tails_ = tails_of(conditions_, left, conditions_.has_temperature());
  const double value = 0.5 * std::log(static_cast<double>(recording_.size()));
  has_outliers_ = is_normal_ && bench_.is_allowed("outliers") &&
                  tails_.outlier_gain > prior_of_sizes + 2.0 * value + 4.0;
  has_warm_noise_ = is_even_ && bench_.is_allowed("noise_temperature") &&
                    tails_.temperature_gain > prior_of_sizes + value;
}

void Search::add_nameless_tails(FoundSet& found) const {
  const double value = 0.5 * std::log(static_cast<double>(recording_.size()));
  const auto add = [&](const std::string& what, double gain, double values) {
    found.unexplained.push_back({what, std::min(1.0, std::exp(values * value - gain))});
  };
  if (is_normal_ && !has_outliers_) add("tails of the noise", tails_.outlier_gain, 2.0);
  if (is_even_ && !has_warm_noise_) add("noise over temperature", tails_.temperature_gain, 1.0);
}

Standing Search::searched_beside_tails(Standing standing) {
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    const auto hidden = bench_.masked();
    judge_tails(standing);
    if (round == 0 && has_outliers_) {
      // What a motion leaves must not pass for outliers.
      const auto all = candidates_;
      std::erase_if(candidates_,
                    [](const auto* cause) { return band_of(cause->id) != Band::motion; });
      standing = searched(std::move(standing));
      candidates_ = all;
      judge_tails(standing);
    }
    // The largest samples would hide what else there is.
    bench_.mask_only(repeats_);
    bench_.mask_too(edges_of_the_dead_zone(standing.scenario));
    if (has_outliers_) bench_.mask_too(tails_.outliers);
    if (round > 0 && bench_.masked() == hidden) break;
    standing = searched(bench_.refitted(standing.scenario));
  }
  return standing;
}

void Search::add_tails(FoundSet& found) const {
  if (has_outliers_) {
    found.scenario.effects.push_back(with_values(
        "outliers",
        {{"probability", tails_.outlier_probability}, {"std_dps", tails_.outlier_std_dps}}));
    found.members.push_back({"outliers", tails_.outlier_gain - 10.0});
  }
  if (has_warm_noise_) {
    found.scenario.effects.push_back(
        with_values("noise_temperature",
                    {{"relative_per_C", tails_.noise_per_C}, {"reference_C", tails_.reference_C}}));
    found.members.push_back({"noise_temperature", tails_.temperature_gain - 8.0});
  }
}

FoundSet Search::run() {
  FoundSet found;
  tell("reading values", 3);
  const auto marks = marks_of(simulator_, recording_);
  tell("fitting the baseline", 3);
  found.baseline = bench_.beside_noise({}).scenario;
  const auto marked = read_off(marks, found);
  for (const auto& cause : cause_types())
    if (bench_.is_allowed(cause.id) && !is_compass(cause) && !bench_.is_marked(cause.id))
      candidates_.push_back(&cause);

  const auto begun = bench_.beside_noise(marked);
  // Rounding to more than the noise is no longer noise, unless a motion dithers it: what it does to
  // the fast part and to slow noise has no law here. Rounded to nearly as much, samples are no
  // longer normal: their tails say nothing. In between, the size of rounded noise depends on where
  // between two values the level is, which temperature moves: at the limit by a part in five
  // hundred (from the first harmonic of the rounding error; Widrow and Kollar, "Quantization
  // Noise", 2008, 4.3), which is what a long recording could show.
  constexpr double coarsest = 2.2, coarsest_for_tails = 1.2, coarsest_for_size = 1.6;
  const double lsb_of_noise = marks.lsb_dps / white_with_rounding(begun.scenario);
  const bool coarse = lsb_of_noise > coarsest && !marks.turns_through_grid;
  is_normal_ = lsb_of_noise < coarsest_for_tails;
  is_even_ = lsb_of_noise < coarsest_for_size || marks.turns_through_grid;
  if (coarse)
    std::erase_if(candidates_, [](const auto* cause) {
      const auto band = band_of(cause->id);
      return band == Band::fast || band == Band::slow;
    });

  tell("the first effect", 3);
  auto standing = searched_beside_tails(begun);
  standing = exchanged(std::move(standing), found);
  if (auto other = beside_memory(standing);
      other.score > standing.score + least_gain(other, Band::fast)) {
    found.members.clear();
    for (const auto& effect : marked) add_mark(effect.id(), found);
    standing = exchanged(searched(std::move(other)), found);
    if (standing.scenario.random_error.phi != 0.0)
      found.baseline = bench_.beside_memory(bench_.beside_noise({})).scenario;
  }
  tell("looking for what has no name", 1);
  found.gain = standing.score - begun.score;
  found.unexplained = unexplained_by(conditions_, *standing.fitter, standing.scenario);
  add_nameless_tails(found);
  found.screening = screening_;
  found.scenario = standing.scenario;
  found.intervals = bench_.intervals_of(standing);
  if (!coarse) end_ = standing;
  add_tails(found);
  auto unseen = edges_of_the_dead_zone(standing.scenario);
  for (std::size_t i = 0; i < unseen.size(); ++i) unseen[i] |= repeats_[i];
  if (has_outliers_)
    for (std::size_t i = 0; i < unseen.size(); ++i)
      if (tails_.outliers[i] != 0) unseen[i] = 1;
  name_lines(bench_, unseen, found);
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
  found.nameless = [search](const Scenario& set) { return search->nameless_beside(set); };
  return found;
}

}  // namespace gyrostat::gap
