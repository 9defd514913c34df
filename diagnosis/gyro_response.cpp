#include <gyrostat/diagnosis/gyro_response.hpp>

#include <cassert>
#include <utility>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {

GyroResponse::GyroResponse(const Series& conditions) : work_([this] { return prepared_; }) {
  hold_influences(conditions, prepared_);
  prepared_.gyro_dps = prepared_.rate_ref_dps;
  still_dps_ = prepared_.gyro_dps;
  for (std::size_t i = 0; i < conditions.gyro_dps.size(); ++i)
    if (is_missing(conditions.gyro_dps[i])) gaps_.push_back(i);
  for (const std::size_t i : gaps_) still_dps_[i] = no_value;
}

std::vector<double> GyroResponse::of(const std::vector<Effect>& effects) const {
  Scenario scenario;
  scenario.effects = effects;
  const auto on_gyro = effects_on_gyro(scenario);
  assert(on_gyro.size() == effects.size());
  if (on_gyro.empty()) return still_dps_;
  Series& series = work_.local();
  series.gyro_dps = prepared_.gyro_dps;
  apply_in_order(on_gyro, {}, series);
  auto gyro = std::move(series.gyro_dps);
  for (const std::size_t i : gaps_) gyro[i] = no_value;
  return gyro;
}

}  // namespace gyrostat::gap
