#include <gyrostat/experiments/study/fleet.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include <gyrostat/analysis/statistics/random_effects.hpp>
#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr double most_apart = 1000.0;  ///< of one kind of sensor: a factor
constexpr std::uint64_t most_attempts = 1000;

/// theta of a unit; where delta1 is 0 there is none.
double ratio_of(const Scenario& scenario) { return scenario.random_error.theta(); }

/// The law of a parameter from its values, where `error` has their standard errors or a NaN.
FleetLaw law_of(const FieldInfo& field, std::size_t units, const std::vector<std::size_t>& members,
                const std::vector<double>& values, const std::vector<double>& errors) {
  FleetLaw law{.name = std::string(field.name),
               .unit = std::string(field.unit),
               .allowed = field.range,
               .direction = std::vector<double>(units)};
  law.mean = values.front();
  const bool constant =
      std::all_of(values.begin(), values.end(), [&](double v) { return v == values.front(); });
  if (constant) return law;  // one unit alone, a choice, a step of the converter

  law.logarithmic = field.range.from == 0.0 &&
                    std::none_of(values.begin(), values.end(), [](double v) { return v <= 0.0; });
  const bool known =
      std::all_of(errors.begin(), errors.end(), [](double e) { return std::isfinite(e) && e > 0; });
  std::vector<MemberValue> on_scale;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = known ? errors[i] : 0.0;
    on_scale.push_back(law.logarithmic ? MemberValue{std::log(values[i]), error / values[i]}
                                       : MemberValue{values[i], error});
  }
  const auto population = random_effects(on_scale);
  law.mean = population.mean;
  law.scale = std::hypot(population.spread, population.mean_error);
  law.degrees = static_cast<double>(values.size()) - 1.0;
  double plain_mean = 0.0, squares = 0.0;
  for (const auto& v : on_scale) plain_mean += v.value / static_cast<double>(on_scale.size());
  for (const auto& v : on_scale) squares += (v.value - plain_mean) * (v.value - plain_mean);
  for (std::size_t i = 0; i < members.size(); ++i)
    law.direction[members[i]] = (on_scale[i].value - plain_mean) / std::sqrt(squares);
  return law;
}

template <class P>
void put(P& parameters, const FleetLaw& law, double value) {
  for (const auto& field : P::fields())
    if (field.name == law.name) parameters.*(field.member) = value;
}

constexpr std::string_view ratio_name = "delta2_dps / delta1_dps";

/// Which effect of a unit is the same as which of another: its name, form, and which of its kind.
using EffectKey = std::tuple<std::string, std::string, int>;

std::vector<EffectKey> keys_of(const Scenario& scenario) {
  std::vector<EffectKey> keys;
  for (const auto& effect : scenario.effects) {
    EffectKey key{std::string(effect.id()), form_of(effect), 0};
    while (std::find(keys.begin(), keys.end(), key) != keys.end()) ++std::get<2>(key);
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

std::string form_of(const Effect& effect) {
  std::string form;
  for (std::size_t field = 0; field < effect.fields().size(); ++field)
    if (const auto& described = effect.fields()[field]; described.range.whole)
      form +=
          fmt::format("{}{} {:g}", form.empty() ? "" : ", ", described.name, effect.value(field));
  return form;
}

double FleetLaw::value_at(double on_scale) const {
  return logarithmic ? std::exp(on_scale) : on_scale;
}

bool FleetLaw::takes(double value) const {
  const bool near = !logarithmic || std::abs(std::log(value) - mean) <= std::log(most_apart);
  return std::isfinite(value) && allowed.contains(value) && near;
}

/// The deviates of one attempt: one a unit, and the squares that Student's law divides by.
class Fleet::Deviates {
 public:
  Deviates(const Noise& noise, std::size_t units, std::uint64_t attempt)
      : of_units_(units), of_scale_(units) {
    noise.stream("fleet").fill(attempt * units, of_units_);
    noise.stream("fleet_scale").fill(attempt * units, of_scale_);
  }

  double value(const FleetLaw& law) const {
    if (law.scale == 0.0) return law.value_at(law.mean);
    double normal = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < of_units_.size(); ++i) normal += law.direction[i] * of_units_[i];
    for (std::size_t i = 0; i < static_cast<std::size_t>(law.degrees); ++i)
      squares += of_scale_[i] * of_scale_[i];
    return law.value_at(law.mean + law.scale * normal / std::sqrt(squares / law.degrees));
  }

 private:
  std::vector<double> of_units_, of_scale_;
};

Fleet::Fleet(std::vector<FleetUnit> units, const std::string& place) : units_(std::move(units)) {
  if (units_.size() < 2)
    throw InputError(place, fmt::format("a fleet of {}; the next one is foretold from 2 or more",
                                        units_.size() == 1 ? "1 unit" : "no unit"));
  const double rate_hz = units_.front().scenario.sampling.rate_hz;
  for (const auto& unit : units_)
    if (std::abs(unit.scenario.sampling.rate_hz / rate_hz - 1.0) > 0.01)
      throw InputError(place, fmt::format("{} is sampled at {:.6g} Hz, {} at {:.6g} Hz; allowed: "
                                          "the same within 1 %, since random errors are steps a "
                                          "sample",
                                          unit.name, unit.scenario.sampling.rate_hz,
                                          units_.front().name, rate_hz));
  std::vector<std::size_t> all(units_.size());
  for (std::size_t u = 0; u < all.size(); ++u) all[u] = u;
  const std::vector<double> unknown(units_.size(), std::nan(""));
  const auto add = [&](const FieldInfo& field, const auto& value_of) {
    std::vector<double> values;
    for (const auto& unit : units_) values.push_back(value_of(unit.scenario));
    laws_.push_back(law_of(field, units_.size(), all, values, unknown));
  };
  by_ratio_ = std::all_of(units_.begin(), units_.end(), [](const auto& unit) {
    return ranges::stationary.contains(ratio_of(unit.scenario));
  });
  const auto errors = field_infos_of<Arima111<double>>;
  for (std::size_t f = 0; f < errors.size(); ++f)
    if (by_ratio_ && errors[f].name == "delta2_dps")
      add({.name = ratio_name, .unit = "1", .range = ranges::stationary, .doc = ""}, ratio_of);
    else
      add(errors[f], [&](const Scenario& s) {
        return s.random_error.*(Arima111<double>::fields()[f].member);
      });
  const auto drifts = field_infos_of<ThermalDrift<double>>;
  for (std::size_t f = 0; f < drifts.size(); ++f)
    add(drifts[f], [&](const Scenario& s) {
      return s.thermal_drift.*(ThermalDrift<double>::fields()[f].member);
    });

  std::map<EffectKey, std::vector<std::pair<std::size_t, std::size_t>>> found;
  for (std::size_t u = 0; u < units_.size(); ++u) {
    const auto keys = keys_of(units_[u].scenario);
    for (std::size_t e = 0; e < keys.size(); ++e) found[keys[e]].emplace_back(u, e);
    effect_laws_.emplace_back(keys.size());
  }
  for (const auto& [key, members] : found) {
    std::vector<std::size_t> with;
    for (const auto& [u, e] : members) with.push_back(u);
    const auto& first = units_[members.front().first].scenario.effects[members.front().second];
    for (std::size_t f = 0; f < first.fields().size(); ++f) {
      std::vector<double> values, of_values;
      for (const auto& [u, e] : members) {
        const auto& errors_of_unit = units_[u].errors;
        values.push_back(units_[u].scenario.effects[e].value(f));
        of_values.push_back(e < errors_of_unit.size() && f < errors_of_unit[e].size()
                                ? errors_of_unit[e][f]
                                : std::nan(""));
      }
      auto law = law_of(first.fields()[f], units_.size(), with, values, of_values);
      law.name = fmt::format("{}.{}", first.id(), law.name);
      for (const auto& [u, e] : members) effect_laws_[u][e].fields.push_back(law);
    }
  }

  nominal_.sampling.rate_hz = rate_hz;
  for (const auto& law : laws_) {
    put(nominal_.random_error, law, law.value_at(law.mean));
    put(nominal_.thermal_drift, law, law.value_at(law.mean));
    if (law.name == ratio_name)
      nominal_.random_error.delta2_dps = law.mean * nominal_.random_error.delta1_dps;
  }
  for (const auto& [key, members] : found) {
    if (2 * members.size() <= units_.size()) continue;
    const auto [u, e] = members.front();
    auto& effect = nominal_.effects.emplace_back(units_[u].scenario.effects[e]);
    for (std::size_t f = 0; f < effect.fields().size(); ++f) {
      const auto& law = effect_laws_[u][e].fields[f];
      effect.value(f) = law.value_at(law.mean);
    }
  }
}

void Fleet::settle(const std::set<std::string>& stated, Scenario& nominal,
                   const std::string& place) {
  stated_ = stated;
  if (stated_.contains("delta2_dps")) stated_.insert(std::string(ratio_name));
  for (const auto& law : laws_)
    if (law.name == ratio_name && is_drawn(law))
      nominal.random_error.delta2_dps = law.mean * nominal.random_error.delta1_dps;
  constexpr std::uint32_t tried = 400;
  Scenario drawn;
  double redrawn = 0.0;
  for (std::size_t unit = 0; unit < units_.size(); ++unit) {
    std::map<std::string, int> beyond;
    std::uint32_t failed = 0;
    for (std::uint32_t trial = 0; trial < tried; ++trial) {
      const FleetLaw* law = nullptr;
      if (try_draw(nominal, unit, Deviates({0, trial}, units_.size(), 0), drawn, &law)) continue;
      ++failed;
      ++beyond[law->name];
    }
    redrawn += failed / (double{tried} * static_cast<double>(units_.size()));
    if (2 * failed <= tried) continue;
    const auto most =
        std::max_element(beyond.begin(), beyond.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    throw InputError(
        place, fmt::format("its {} units differ so much that {} of {} sensors drawn from them lie "
                           "beyond what is allowed, mostly in {}; allowed: up to half. State that "
                           "parameter in the scenario, or give more units",
                           units_.size(), failed, tried, most->first));
  }
  redrawn_ = redrawn;
}

bool Fleet::try_draw(const Scenario& nominal, std::size_t unit, const Deviates& deviates,
                     Scenario& drawn, const FleetLaw** beyond) const {
  drawn = nominal;
  for (const auto& law : laws_) {
    if (!is_drawn(law)) continue;
    const double value = deviates.value(law);
    if (!law.takes(value)) {
      *beyond = &law;
      return false;
    }
    put(drawn.random_error, law, value);
    put(drawn.thermal_drift, law, value);
    if (law.name == ratio_name)
      drawn.random_error.delta2_dps = value * drawn.random_error.delta1_dps;
  }
  if (!draws_effects()) return true;
  drawn.effects = units_[unit].scenario.effects;
  for (std::size_t e = 0; e < drawn.effects.size(); ++e)
    for (std::size_t f = 0; f < drawn.effects[e].fields().size(); ++f) {
      const auto& law = effect_laws_[unit][e].fields[f];
      drawn.effects[e].value(f) = deviates.value(law);
      if (law.takes(drawn.effects[e].value(f))) continue;
      *beyond = &law;
      return false;
    }
  return true;
}

void Fleet::draw(const Scenario& nominal, const Noise& noise, Scenario& drawn) const {
  const double share = noise.stream("fleet_unit").uniform(0);
  const auto unit = std::min(units_.size() - 1,
                             static_cast<std::size_t>(share * static_cast<double>(units_.size())));
  const FleetLaw* beyond = nullptr;
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt)
    if (try_draw(nominal, unit, Deviates(noise, units_.size(), attempt), drawn, &beyond)) return;
  throw std::runtime_error(
      fmt::format("{} sensors drawn from the fleet lie beyond what is allowed", most_attempts));
}

std::string sensor_in_words(const Scenario& sensor) {
  std::string words;
  const auto add = [&](const auto& parameters) {
    for (const auto& field : parameters.fields())
      words += fmt::format("{}{} {:.4g}", words.empty() ? "" : ", ", field.name,
                           parameters.*(field.member));
  };
  add(sensor.random_error);
  add(sensor.thermal_drift);
  for (const auto& effect : sensor.effects) {
    words += fmt::format(", {} (", effect.id());
    for (std::size_t f = 0; f < effect.fields().size(); ++f)
      words +=
          fmt::format("{}{} {:.4g}", f == 0 ? "" : ", ", effect.fields()[f].name, effect.value(f));
    words += ")";
  }
  return words;
}

}  // namespace gyrostat
