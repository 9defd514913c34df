#include <gyrostat/experiments/study/fleet_law.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/analysis/statistics/random_effects.hpp>

namespace gyrostat {
namespace {

constexpr double most_apart = 1000.0;  ///< of one kind of sensor: a factor

}  // namespace

FleetLaw fleet_law(const FieldInfo& field, std::size_t units,
                   const std::vector<std::size_t>& members, const std::vector<double>& values,
                   const std::vector<double>& errors) {
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

double FleetLaw::value_at(double on_scale) const {
  return logarithmic ? std::exp(on_scale) : on_scale;
}

bool FleetLaw::takes(double value) const {
  const bool near = !logarithmic || std::abs(std::log(value) - mean) <= std::log(most_apart);
  return std::isfinite(value) && allowed.contains(value) && near;
}

}  // namespace gyrostat
