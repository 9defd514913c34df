#include <gyrostat/diagnosis/likelihood/set_search.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

#include <gyrostat/diagnosis/likelihood/compass_search.hpp>
#include <gyrostat/diagnosis/likelihood/effect_band.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/line_names.hpp>
#include <gyrostat/diagnosis/likelihood/set_searcher.hpp>

namespace gyrostat::gap {
namespace {

bool is_compass(const CauseType& cause) { return cause.effect().stage() == Stage::compass; }

/// Where a motion hardly stays near zero, what is cut off towards it shows as a zone that takes
/// half a step off each value.
bool has_zone_of_half_a_step(const Scenario& scenario) {
  constexpr double near = 0.06, nearly_all = 0.9;
  double step_dps = 0.0, lost_dps = 0.0;
  for (const auto& effect : scenario.effects) {
    const auto value = [&](std::string_view name) { return effect.value(field_of(effect, name)); };
    if (effect.id() == "quantization" && value("towards_zero") == 0.0) step_dps = value("lsb_dps");
    if (effect.id() == "dead_zone" && value("of_output") == 0.0 &&
        value("lost_beyond") > nearly_all)
      lost_dps = value("half_width_dps");
  }
  return step_dps > 0.0 && std::abs(lost_dps - 0.5 * step_dps) < near * 0.5 * step_dps;
}

/// What may be asked of a set that the searcher found last.
FoundSet that_may_be_asked(FoundSet found, const std::shared_ptr<SetSearcher>& search) {
  found.subset = [search, whole = found.scenario](const std::vector<std::string>& names) {
    return search->subset_of(whole, names, SetSearcher::Anew::noise);
  };
  found.anew = [search, whole = found.scenario](const std::vector<std::string>& names) {
    return search->subset_of(whole, names, SetSearcher::Anew::all);
  };
  if (search->has_law()) {
    found.worth = [search](std::string_view part, const std::vector<Effect>& effects) {
      return search->worth_with(part, effects);
    };
    found.beside = [search](const std::vector<Given>& given) {
      return that_may_be_asked(search->beside(given), search);
    };
  }
  found.nameless = [search](const Scenario& set) { return search->nameless_beside(set); };
  found.detectable = [search] { return search->detectable(); };
  return found;
}

}  // namespace

FoundSet SetSearcher::run() {
  FoundSet found;
  tell("reading values", 3);
  marks_ = marks_of(simulator_, recording_);
  tell("fitting the baseline", 3);
  bare_ = bench_.beside_noise({});
  found.baseline = bare_.scenario;
  auto marked = read_off(marks_, found);
  for (const auto& cause : cause_types())
    if (bench_.is_allowed(cause.id) && !is_compass(cause) && !bench_.is_marked(cause.id))
      candidates_.push_back(&cause);

  begun_ = bench_.beside_noise(marked);
  // Rounding to more than the noise is no longer noise, unless a motion dithers it.
  constexpr double coarsest = 2.2;
  const double widest_cell_dps = (is_cut_off_ ? 2.0 : 1.0) * marks_.lsb_dps;
  const double cell_of_noise =
      widest_cell_dps / (marks_.level_on_grid_dps ? marks_.white_under_grid_dps
                                                  : noise_on_grid(begun_.scenario, marks_));
  is_coarse_ = cell_of_noise > coarsest && !marks_.turns_through_grid;
  constexpr double least_told = 0.1;
  const bool is_drawn =
      is_coarse_ && bench_.is_allowed("quantization") &&
      share_off_their_neighbours(recording_.gyro_dps, bench_.known_rate(begun_.scenario),
                                 marks_.lsb_dps) > least_told;
  if (is_drawn) {
    before_rounding_.emplace(
        recording_.gyro_dps, repeats_, marks_.lsb_dps,
        is_cut_off_ ? BeforeRounding::Cells::twice_as_wide_at_zero : BeforeRounding::Cells::alike);
    coarse_grid_ = marked.front();
    marked.erase(marked.begin());
    constexpr double level_s = 10.0;
    constexpr int draws = 240;
    Scenario bare = bench_.plain();
    bare.effects = marked;
    before_rounding_->draw_under_own(bench_.known_rate(bare),
                                     static_cast<std::size_t>(level_s * conditions_.rate_hz()) + 1,
                                     draws);
    recording_.gyro_dps = before_rounding_->rate_dps();
    bare_ = bench_.beside_noise({});
    begun_ = bench_.beside_noise(marked);
    is_coarse_ = false;
  } else if (is_coarse_)
    feigned_ = {.warmth = 1e300, .tails = 1e300};
  else if (!marks_.turns_through_grid) {
    feigned_ = feigned_by_grid(cell_of_noise);
    undithered_lsb_dps_ = widest_cell_dps;
  }
  if (is_coarse_)
    std::erase_if(candidates_, [](const auto* cause) {
      const auto band = band_of(cause->id);
      return band == EffectBand::fast || band == EffectBand::slow;
    });

  feigned_colour_ = feigned_by_repeats(marks_);
  tell("the first effect", 3);
  const auto read = found.members;
  auto standing = concluded(searched_beside_tails(begun_), found);
  if (is_drawn) {
    found.members = read;
    standing = drawn_anew(std::move(standing), found);
    // Likelihoods of other draws are not to be compared.
    begun_ = bench_.beside_noise(begun_.scenario.effects);
    bare_ = bench_.beside_noise({});
  }
  return described(std::move(standing), std::move(found));
}

Standing SetSearcher::concluded(Standing standing, FoundSet& found) {
  const auto known = found.members;
  standing = exchanged(std::move(standing), found);
  const auto exchanged_anew = [&](Standing other) {
    found.members = known;
    standing = exchanged(std::move(other), found);
  };
  // An exchange may have left the one way of being late of two.
  const bool has_nameless = bench_.response().has_value();
  if (auto other = responding_anew(standing);
      other.score > standing.score || (has_nameless && !bench_.response()))
    exchanged_anew(std::move(other));
  // Any effect is stranger than what the baseline has itself.
  constexpr double surely = 2.2;
  auto other = beside_memory(standing);
  const bool is_in_place = other.scenario.effects.size() < standing.scenario.effects.size();
  if (other.score >
      standing.score + least_gain(other, EffectBand::fast) - (is_in_place ? surely : 0.0)) {
    exchanged_anew(searched(std::move(other)));
    if (standing.scenario.random_error.phi != 0.0)
      found.baseline = bench_.beside_memory(bench_.beside_noise({})).scenario;
  } else {
    // What the memory could stand in for is no surer than that.
    for (auto& member : found.members)
      if (!member.read_off && !has(other.scenario, member.effect))
        member.log_odds = std::min(member.log_odds, standing.score - other.score);
  }
  standing = without_the_doubtful(without_what_others_are(std::move(standing), found), found);
  return beside_a_line_within(std::move(standing), found);
}

FoundSet SetSearcher::described(Standing standing, FoundSet found) {
  searched_ = found;
  tell("looking for what has no name", 1);
  found.scenario = standing.scenario;
  found.score = standing.score;
  found.gain = standing.score - begun_.score;
  found.unexplained = unexplained_by(conditions_, *standing.fitter, standing.scenario);
  // What rounding to more than the noise leaves has another spectrum than the noise; so have
  // repeats that are not told, down to where the noise of means is larger than it should be.
  std::erase_if(found.unexplained, [&](const auto& u) {
    return (u.what == "spectrum" && (is_coarse_ || !marks_.repeats_are_told)) ||
           (u.what == "memory" && !marks_.repeats_are_told);
  });
  add_nameless_tails(found);
  found.screening = screening_;
  found.intervals = bench_.intervals_of(standing);
  place_threshold(found);
  if (!is_coarse_) end_ = standing;
  response_ = bench_.response();
  masked_ = bench_.masked();
  if (std::none_of(masked_.begin(), masked_.end(), [](char hidden) { return hidden != 0; }))
    found.log_score_gained =
        standing.score - bare_.score + (has_warm_noise_ ? tails_.temperature_gain : 0.0);
  add_tails(found);
  auto unseen = edges_of_the_dead_zone(standing.scenario);
  for (std::size_t i = 0; i < unseen.size(); ++i) unseen[i] |= repeats_[i];
  if (has_outliers_)
    for (std::size_t i = 0; i < unseen.size(); ++i)
      if (tails_.outliers[i] != 0) unseen[i] = 1;
  name_lines(bench_, standing, unseen, found);
  join_gated_sines(unseen, found);
  look_for_transients(unseen, found);
  auto& drift = found.scenario.thermal_drift;
  const auto& coefficients = standing.fit.drift;
  drift = {.a_dps_per_C = coefficients.size() > 0 ? coefficients[0] : 0.0,
           .b_dps_s_per_C = coefficients.size() > 1 ? coefficients[1] : 0.0,
           .c_dps = 0.0};
  if (coarse_grid_) {
    put_grid_back(found.scenario);
    for (auto& interval : found.intervals) ++interval.effect;
    found.before_rounding_dps = recording_.gyro_dps;
  }
  // Of what rests, and is nothing but noise, counts of values say more than a draw.
  if (is_coarse_ || (coarse_grid_ && marks_.level_on_grid_dps && found.members.size() == 1)) {
    white_at_rest_dps_ = marks_.white_under_grid_dps;
    found.scenario.random_error.measurement_noise_std_dps = *white_at_rest_dps_;
    found.level_on_grid_dps = marks_.level_on_grid_dps;
  }
  give_grid_to_angle(marks_, found);
  put_in_order(found);
  if (conditions_.has_heading()) search_compass(simulator_, recording_, options_, found);
  return found;
}

Scenario SetSearcher::likeliest_baseline() {
  FoundSet found{.baseline = bench_.beside_noise({}).scenario, .scenario = bench_.plain()};
  if (conditions_.has_heading()) search_compass(simulator_, recording_, options_, found);
  return found.baseline;
}

Scenario likeliest_baseline(const Simulator& simulator, const Series& recording) {
  SetSearchOptions nothing;
  for (const auto& cause : cause_types()) nothing.without.emplace_back(cause.id);
  return SetSearcher(simulator, recording, nothing, {}).likeliest_baseline();
}

FoundSet find_set(const Simulator& simulator, const Series& recording,
                  const SetSearchOptions& options, const SetSearchProgress& progress) {
  auto search = std::make_shared<SetSearcher>(simulator, recording, options, progress);
  auto found = search->run();
  if (!options.is_cut_off && has_zone_of_half_a_step(found.scenario)) {
    auto cut_off = options;
    cut_off.is_cut_off = true;
    auto other_search = std::make_shared<SetSearcher>(simulator, recording, cut_off, progress);
    if (auto other = other_search->run(); !has(other.scenario, "dead_zone"))
      return that_may_be_asked(std::move(other), other_search);
  }
  return that_may_be_asked(std::move(found), search);
}

}  // namespace gyrostat::gap
