#include <gyrostat/experiments/study/fleet.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>

namespace gyrostat {
namespace {

constexpr std::uint64_t most_attempts = 1000;

template <class P>
void put(P& parameters, const FleetLaw& law, double value) {
  for (const auto& field : P::fields())
    if (field.name == law.name) parameters.*(field.member) = value;
}

constexpr std::string_view ratio_name = "delta2_dps / delta1_dps";

}  // namespace

std::string form_of(const Effect& effect) {
  std::string form;
  for (std::size_t field = 0; field < effect.fields().size(); ++field)
    if (const auto& described = effect.fields()[field]; described.range.whole)
      form +=
          fmt::format("{}{} {:g}", form.empty() ? "" : ", ", described.name, effect.value(field));
  return form;
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
  require_one_rate(place);
  add_laws();
  Found found;
  for (std::size_t u = 0; u < units_.size(); ++u) {
    const auto keys = keys_of(units_[u].scenario);
    for (std::size_t e = 0; e < keys.size(); ++e) found[keys[e]].emplace_back(u, e);
    effect_laws_.emplace_back(keys.size());
  }
  add_effect_laws(found);
  make_nominal(found);
}

void Fleet::require_one_rate(const std::string& place) const {
  const double rate_hz = units_.front().scenario.sampling.rate_hz;
  for (const auto& unit : units_)
    if (std::abs(unit.scenario.sampling.rate_hz / rate_hz - 1.0) > 0.01)
      throw InputError(place, fmt::format("{} is sampled at {:.6g} Hz, {} at {:.6g} Hz; allowed: "
                                          "the same within 1 %, since random errors are steps a "
                                          "sample",
                                          unit.name, unit.scenario.sampling.rate_hz,
                                          units_.front().name, rate_hz));
}

void Fleet::add_laws() {
  std::vector<std::size_t> all(units_.size());
  for (std::size_t u = 0; u < all.size(); ++u) all[u] = u;
  const std::vector<double> unknown(units_.size(), std::nan(""));
  const auto add = [&](const FieldInfo& field, const auto& value_of) {
    std::vector<double> values;
    for (const auto& unit : units_) values.push_back(value_of(unit.scenario));
    laws_.push_back(fleet_law(field, units_.size(), all, values, unknown));
  };
  // delta2 is drawn by theta = delta2 / delta1.
  const bool by_ratio = std::all_of(units_.begin(), units_.end(), [](const auto& unit) {
    return ranges::stationary.contains(unit.scenario.random_error.theta());
  });
  const auto errors = field_infos_of<Arima111<double>>;
  for (std::size_t f = 0; f < errors.size(); ++f)
    if (by_ratio && errors[f].name == "delta2_dps")
      add({.name = ratio_name, .unit = "1", .range = ranges::stationary, .doc = ""},
          [](const Scenario& s) { return s.random_error.theta(); });
    else
      add(errors[f], [&](const Scenario& s) {
        return s.random_error.*(Arima111<double>::fields()[f].member);
      });
  const auto drifts = field_infos_of<ThermalDrift<double>>;
  for (std::size_t f = 0; f < drifts.size(); ++f)
    add(drifts[f], [&](const Scenario& s) {
      return s.thermal_drift.*(ThermalDrift<double>::fields()[f].member);
    });
}

std::vector<Fleet::EffectKey> Fleet::keys_of(const Scenario& scenario) {
  std::vector<EffectKey> keys;
  for (const auto& effect : scenario.effects) {
    EffectKey key{std::string(effect.id()), form_of(effect), 0};
    while (std::find(keys.begin(), keys.end(), key) != keys.end()) ++std::get<2>(key);
    keys.push_back(key);
  }
  return keys;
}

void Fleet::add_effect_laws(const Found& found) {
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
      auto law = fleet_law(first.fields()[f], units_.size(), with, values, of_values);
      law.name = fmt::format("{}.{}", first.id(), law.name);
      for (const auto& [u, e] : members) effect_laws_[u][e].push_back(law);
    }
  }
}

void Fleet::make_nominal(const Found& found) {
  nominal_.sampling.rate_hz = units_.front().scenario.sampling.rate_hz;
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
      const auto& law = effect_laws_[u][e][f];
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
      const auto& law = effect_laws_[unit][e][f];
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
