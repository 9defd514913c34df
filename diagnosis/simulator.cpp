#include <gyrostat/diagnosis/simulator.hpp>

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace gyrostat::gap {
namespace {

/// The coarsest power of ten that all values are multiples of, unless it is comparable with the
/// noise: then it is the sensor's grid and not the file's.
double decimal_step(const std::vector<double>& values, const std::vector<Span>& spans) {
  std::vector<double> inspected, steps;
  for (const auto& span : spans)
    for (std::size_t i = span.first; i < span.last && inspected.size() < 2000; ++i) {
      if (is_missing(values[i])) continue;
      if (!inspected.empty()) steps.push_back(std::abs(values[i] - inspected.back()));
      inspected.push_back(values[i]);
    }
  if (steps.empty()) return 0.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  for (int decimals = 0; decimals <= 9; ++decimals) {
    const double scale = std::pow(10.0, decimals);
    const bool all = std::all_of(inspected.begin(), inspected.end(), [&](double v) {
      return std::abs(v * scale - std::nearbyint(v * scale)) <
             1e-6 * std::max(1.0, std::abs(v * scale) * 1e-6);
    });
    if (all) return 1.0 / scale < 0.1 * *middle ? 1.0 / scale : 0.0;
  }
  return 0.0;
}

template <class P>
bool differ(const P& a, const P& b) {
  const auto fields = P::fields();
  return std::any_of(fields.begin(), fields.end(),
                     [&](const auto& field) { return a.*(field.member) != b.*(field.member); });
}

bool differ(const Effect& a, const Effect& b) {
  if (&a.type() != &b.type()) return true;
  for (std::size_t f = 0; f < a.fields().size(); ++f)
    if (a.value(f) != b.value(f)) return true;
  return false;
}

/// Whether replicas do: in what a scenario makes of a recording's conditions.
bool replicas_differ(const Scenario& a, const Scenario& b) {
  return differ(a.compass, b.compass) || differ(a.random_error, b.random_error) ||
         differ(a.thermal_drift, b.thermal_drift) || a.recorded_noise_dps != b.recorded_noise_dps ||
         !std::equal(a.effects.begin(), a.effects.end(), b.effects.begin(), b.effects.end(),
                     [](const auto& x, const auto& y) { return !differ(x, y); });
}

bool effects_at(const Scenario& scenario, bool compass) {
  return std::any_of(scenario.effects.begin(), scenario.effects.end(),
                     [&](const auto& any) { return (any.stage() == Stage::compass) == compass; });
}

}  // namespace

Simulator::Simulator(const Series& recording, std::uint64_t seed, Interrupt interrupt, Split split)
    : interrupt_(interrupt),
      conditions_(recording, split),
      response_(conditions_.series()),
      instruments_{Instrument(conditions_, Part::train), Instrument(conditions_, Part::held_out)},
      seed_(seed),
      resolution_dps_(decimal_step(recording.gyro_dps, conditions_.spans(Part::train))) {
  interrupt_.check();
}

void Simulator::to_resolution(Series& series) const {
  if (resolution_dps_ > 0.0)
    for (double& z : series.gyro_dps) z = resolution_dps_ * std::nearbyint(z / resolution_dps_);
}

/// Without b T': the lenses take the drift's slope out of the slow values.
Scenario Simulator::simulable(Scenario scenario) {
  scenario.thermal_drift.b_dps_s_per_C = 0.0;
  return scenario;
}

Series Simulator::replica(const Scenario& scenario, std::uint32_t number) const {
  Series series;
  synthesise_under(simulable(scenario), conditions_.series(), {seed_, number}, series);
  to_resolution(series);
  return series;
}

Readings Simulator::readings(const Series& series, std::span<const Part> of) const {
  const Scene scene(conditions_, series, of);
  Readings result;
  for (const Part part : of) result[index_of(part)] = instrument(part).read(scene);
  return result;
}

void Simulator::remember(const Scenario& scenario, std::uint32_t first, std::size_t count) {
  memory_.clear();
  remembered_ = scenario;
  remember_more(first, count);
}

void Simulator::remember_more(std::uint32_t first, std::size_t count) {
  const auto all = ensemble(remembered_, first, count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    memory_[first + static_cast<std::uint32_t>(k)] = {all[0].col(column), all[1].col(column)};
  }
}

Readings Simulator::replica_readings(const Scenario& scenario, std::uint32_t number,
                                     std::span<const Part> of) const {
  interrupt_.check();
  const auto known = memory_.find(number);
  if (known == memory_.end()) return readings(replica(scenario, number), of);
  const bool heading = differ(scenario.compass, remembered_.compass) ||
                       effects_at(scenario, true) || effects_at(remembered_, true);
  const bool rate = differ(scenario.random_error, remembered_.random_error) ||
                    differ(scenario.thermal_drift, remembered_.thermal_drift) ||
                    effects_at(scenario, false) || effects_at(remembered_, false);
  Readings result = known->second;
  Series series;
  if (rate) {
    synthesise_rate_under(simulable(scenario), conditions_.series(), {seed_, number}, series);
    to_resolution(series);
    const Scene scene(conditions_, series, of);
    for (const Part part : of) instrument(part).read(scene, "gyro_dps", result[index_of(part)]);
  }
  if (heading && conditions_.has_heading()) {
    synthesise_heading_under(scenario, conditions_.series(), {seed_, number}, series);
    series.gyro_dps.clear();
    const Scene scene(conditions_, series, of);
    for (const Part part : of) instrument(part).read(scene, "heading_deg", result[index_of(part)]);
  }
  return result;
}

ReplicaReadings Simulator::ensemble(const Scenario& scenario, std::uint32_t first,
                                    std::size_t count, std::span<const Part> of) const {
  ReplicaReadings all;
  for (const Part part : of)
    all[index_of(part)].resize(instrument(part).size(), static_cast<Eigen::Index>(count));
  const bool of_all = of.size() == both_parts.size();
  std::vector<const Readings*> known(count, nullptr);
  if (of_all) {
    const std::scoped_lock lock(mutex_);
    const auto& kept = kept_of(scenario);
    for (std::size_t k = 0; k < count; ++k)
      if (const auto at = kept.find(first + static_cast<std::uint32_t>(k)); at != kept.end())
        known[k] = &at->second;
  }
  std::vector<Readings> read(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    if (known[k] == nullptr)
      read[k] = replica_readings(scenario, first + static_cast<std::uint32_t>(k), of);
    const auto& of_one = known[k] == nullptr ? read[k] : *known[k];
    for (const Part part : of)
      all[index_of(part)].col(static_cast<Eigen::Index>(k)) = of_one[index_of(part)];
  });
  if (!of_all) return all;
  const std::scoped_lock lock(mutex_);
  auto& kept = kept_of(scenario);
  for (std::size_t k = 0; k < count; ++k)
    if (known[k] == nullptr)
      kept.try_emplace(first + static_cast<std::uint32_t>(k), std::move(read[k]));
  return all;
}

std::map<std::uint32_t, Readings>& Simulator::kept_of(const Scenario& scenario) const {
  for (auto& kept : kept_)
    if (!replicas_differ(kept.scenario, scenario)) return kept.readings;
  return kept_.emplace_back(Kept{scenario, {}}).readings;
}

Eigen::VectorXd Simulator::mean_train(const Scenario& scenario, std::uint32_t first,
                                      std::size_t count) const {
  return ensemble(scenario, first, count, train_alone)[0].rowwise().mean();
}

}  // namespace gyrostat::gap
