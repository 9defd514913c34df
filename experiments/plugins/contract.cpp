#include <gyrostat/experiments/plugins/contract.hpp>

#include <bit>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include <gyrostat/generators/environment/acceleration/shaking.hpp>
#include <gyrostat/generators/environment/motion/sinusoidal.hpp>
#include <gyrostat/generators/environment/temperature/cycle.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat {
namespace {

constexpr double extreme = 1e100;    // ends of ranges beyond it are not tried
constexpr std::size_t length = 400;  // samples: one by one they are as many questions

/// A gyro that turns, warms and drifts, with every channel, 20 Hz.
Series tame(std::size_t samples, std::uint32_t trial = 0) {
  Scenario scenario;
  scenario.sampling = {.duration_s = static_cast<double>(samples) / 20.0, .rate_hz = 20.0};
  scenario.random_error = {
      .phi = 0.3, .delta1_dps = 1e-3, .delta2_dps = 5e-4, .measurement_noise_std_dps = 0.05};
  scenario.thermal_drift = {.a_dps_per_C = 0.002, .b_dps_s_per_C = 0.3, .c_dps = -0.05};
  scenario.temperature = temperature::Cycle{.low_C = 20.0, .high_C = 60.0, .period_s = 200.0};
  scenario.motion = motion::Sinusoidal{};
  scenario.cross_motion_1 = motion::Sinusoidal{.amplitude_dps = 20.0, .frequency_hz = 0.07};
  scenario.cross_motion_2 = motion::Sinusoidal{.amplitude_dps = 20.0, .frequency_hz = 0.03};
  scenario.acceleration = acceleration::Shaking{};
  scenario.compass.disturbances = {{.start_s = 40.0, .duration_s = 10.0}};
  Series series;
  synthesise(scenario, {1, trial}, series);
  return series;
}

/// The same with single samples missing and gross errors in others.
Series torn(std::size_t samples) {
  auto series = tame(samples);
  for (std::size_t i = 0; i < samples; i += 3) series.gyro_dps[i] = no_value;
  for (std::size_t i = 1; i < samples; i += 3) series.heading_deg[i] = no_value;
  for (std::size_t i = 2; i < samples; i += 3) series.temperature_C[i] = no_value;
  for (std::size_t i = 100; i < samples; i += 97)
    series.gyro_dps[i] = i % 2 == 0 ? 1000.0 : -1000.0;
  return series;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// The first sample at which two tracks differ, as a sentence; empty where none does.
std::string difference(const Track& track, const Track& from) {
  const std::array columns = {&Track::estimate_dps, &Track::estimate_variance,
                              &Track::innovation_dps, &Track::innovation_variance};
  constexpr std::array names = {"estimate", "variance", "innovation", "innovation variance"};
  for (std::size_t i = 0; i < from.status.size(); ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (const double a = (track.*columns[c])[i], b = (from.*columns[c])[i]; !same_bits(a, b))
        return fmt::format("sample {}: {} {}, not {}", i, names[c], a, b);
    if (track.status[i] != from.status[i])
      return fmt::format("sample {}: status {}, not {}", i, name_of(track.status[i]),
                         name_of(from.status[i]));
  }
  return "";
}

std::string difference(const Series& series, const Series& from) {
  for (const auto& channel : channels)
    for (std::size_t i = 0; i < (from.*channel.values).size(); ++i)
      if (const double a = (series.*channel.values)[i], b = (from.*channel.values)[i];
          !same_bits(a, b))
        return fmt::format("sample {}: {} is {}, not {}", i, channel.name, a, b);
  return "";
}

class Laws {
 public:
  Laws(std::string plugin, std::vector<KeptLaw>& to) : plugin_(std::move(plugin)), to_(to) {}

  /// `broken_by` says what was seen, or throws WorkerFailure.
  void try_law(const std::string& law, const std::function<std::string()>& broken_by) const {
    std::string seen;
    try {
      seen = broken_by();
    } catch (const WorkerFailure& failure) {
      seen = failure.what();
    }
    to_.push_back({plugin_, law, seen});
  }

 private:
  std::string plugin_;
  std::vector<KeptLaw>& to_;
};

/// Calls `with` for parameters of which one is at an end of its range, the others at their
/// defaults.
void at_ends(const PluginDescription& of,
             const std::function<void(const std::vector<double>&)>& with) {
  for (std::size_t i = 0; i < of.fields.size(); ++i) {
    const auto& range = of.fields[i].range;
    for (const double value :
         {range.from, range.to, std::nextafter(range.from, 1.0), std::nextafter(range.to, 0.0)}) {
      if (!range.contains(value) || std::abs(value) > extreme) continue;
      auto values = of.defaults();
      values[i] = value;
      try {
        with(values);
      } catch (const WorkerFailure& failure) {
        throw WorkerFailure(
            fmt::format("with {} = {}: {}", of.fields[i].name, value, failure.what()));
      }
    }
  }
}

/// What a filter makes of the series in a process that has done nothing before.
Track alone(const ForeignFilter& filter, const Series& series,
            std::size_t samples = protocol::samples_of_a_block) {
  Track track;
  filter.workers->with_fresh_one([&](Worker& worker) {
    ForeignTrial trial(*filter.description, worker, filter.description->defaults());
    run_trial_in_blocks(trial, series, track, samples);
  });
  return track;
}

/// In a process that has done a trial before, whole or broken off after `before` samples.
Track after_another(const ForeignFilter& filter, const Series& series, std::size_t before) {
  Track track;
  const auto other = tame(before, 7);
  filter.workers->with_fresh_one([&](Worker& worker) {
    const auto values = filter.description->defaults();
    ForeignTrial first(*filter.description, worker, values);
    track.resize(other.size());
    first.step(other, 0, other.size(), track);
    if (before % 2 == 0) first.end();
    ForeignTrial trial(*filter.description, worker, values);
    run_trial_in_blocks(trial, series, track);
  });
  return track;
}

/// Beside another instance that is given another signal, sample by sample in turns.
Track beside_another(const ForeignFilter& filter, const Series& series) {
  Track track, aside;
  const auto other = tame(series.size(), 7);
  filter.workers->with_fresh_one([&](Worker& worker) {
    const auto values = filter.description->defaults();
    ForeignTrial trial(*filter.description, worker, values);
    ForeignTrial its_neighbour(*filter.description, worker, values, true);
    track.resize(series.size());
    aside.resize(series.size());
    for (std::size_t i = 0; i < series.size(); ++i) {
      trial.step(series, i, 1, track);
      its_neighbour.step(other, i, 1, aside);
    }
    its_neighbour.end();
    trial.end();
  });
  return track;
}

void check_filter(const ForeignFilter& filter, bool is_library, const Laws& laws) {
  const auto series = tame(length);
  Track track;
  laws.try_law("finite estimates", [&]() -> std::string {
    filter.run(filter.description->defaults(), series, track);
    const auto counts = track.status_counts();
    for (std::size_t s = 0; s < counts.size(); ++s)
      if (counts[s] > 0 && is_breakdown(static_cast<Status>(s)))
        return fmt::format("{} in {} steps of a tame signal", status_names[s], counts[s]);
    return "";
  });
  laws.try_law("finite where samples are missing or gross", [&] {
    filter.run(filter.description->defaults(), torn(length), track);
    return std::string();
  });
  if (!filter.description->fields.empty())
    laws.try_law("finite at the ends of parameters", [&] {
      at_ends(*filter.description,
              [&](const auto& values) { filter.run(values, tame(length), track); });
      return std::string();
    });
  Track first;
  laws.try_law("the same bits again", [&] {
    first = alone(filter, series);
    return difference(alone(filter, series), first);
  });
  if (first.status.empty()) return;  // which said why
  laws.try_law("blocks of any size", [&] {
    for (const std::size_t samples : {std::size_t{1}, std::size_t{7}, std::size_t{300}})
      if (const auto seen = difference(alone(filter, series, samples), first); !seen.empty())
        return fmt::format("in blocks of {}, {}", samples, seen);
    return std::string();
  });
  laws.try_law("no trial reaches the next", [&] {
    for (const std::size_t before : {500U, 501U})
      if (const auto seen = difference(after_another(filter, series, before), first); !seen.empty())
        return fmt::format("after another trial, {}", seen);
    return std::string();
  });
  if (is_library)
    laws.try_law("no instance reaches another",
                 [&] { return difference(beside_another(filter, series), first); });
}

void check_effect(const ForeignEffect& effect, const Laws& laws) {
  const auto& description = *effect.description;
  const auto defaults = description.defaults();
  const Noise noise{1, 0};
  const auto series = tame(length);
  const auto alone = [&](const std::vector<double>& values, const Series& on, const Noise& under) {
    auto changed = on;
    effect.workers->with_fresh_one(
        [&](Worker& worker) { effect.apply_in(worker, values, changed, under); });
    return changed;
  };
  laws.try_law("absent it changes nothing",
               [&] { return difference(alone(description.absent, series, noise), series); });
  laws.try_law("numbers stay numbers", [&] {
    (void)alone(defaults, torn(length), noise);
    (void)alone(defaults, tame(1), noise);
    at_ends(description, [&](const auto& values) { (void)alone(values, tame(length), noise); });
    return std::string();
  });
  laws.try_law("the same bits again", [&] {
    return difference(alone(defaults, series, noise), alone(defaults, series, noise));
  });
  laws.try_law("no trial reaches the next", [&] {
    auto changed = series;
    effect.workers->with_fresh_one([&](Worker& worker) {
      auto other = tame(length, 7);
      effect.apply_in(worker, defaults, other, {1, 7});
      effect.apply_in(worker, defaults, changed, noise);
    });
    const auto seen = difference(changed, alone(defaults, series, noise));
    return seen.empty() ? seen : "after another trial, " + seen;
  });
}

}  // namespace

std::vector<KeptLaw> check_contract(const LoadedPlugin& plugin) {
  std::vector<KeptLaw> laws;
  for (const auto& filter : plugin.filters)
    check_filter(filter, plugin.is_library, Laws(filter.description->name, laws));
  for (const auto& effect : plugin.effects)
    check_effect(effect, Laws(effect.description->name, laws));
  return laws;
}

}  // namespace gyrostat
