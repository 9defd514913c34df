#include <gyrostat/diagnosis/compare/counted.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>

namespace gyrostat::gap {
namespace {

template <class Use>
void each_train_sample(const Conditions& conditions, const Use& use) {
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(conditions.series().gyro_dps[i])) use(i);
}

double warming_squared(const Conditions& conditions) {
  const auto& T = conditions.series().temperature_C;
  double count = 0.0, sum = 0.0, squares = 0.0;
  each_train_sample(conditions, [&](std::size_t i) {
    count += 1.0;
    sum += T[i];
    squares += T[i] * T[i];
  });
  return count > 0.0 ? squares - sum * sum / count : 0.0;
}

}  // namespace

std::vector<double> errors_by_count(const Effect& effect, const Conditions& conditions) {
  std::vector<double> errors(effect.fields().size(), no_value);
  const auto set = [&](std::string_view field, double error) {
    if (std::isfinite(error)) errors[field_of(effect, field)] = error;
  };
  if (effect.id() == "noise_temperature") {
    if (conditions.has_temperature())
      set("relative_per_C", 1.0 / std::sqrt(2.0 * warming_squared(conditions)));
    return errors;
  }
  if (effect.id() != "outliers" && effect.id() != "stale_samples") return errors;
  double samples = 0.0;
  each_train_sample(conditions, [&](std::size_t) { samples += 1.0; });
  const double share = effect.value(field_of(effect, "probability"));
  const double hits = std::max(1.0, samples * share);
  set("probability", share * std::sqrt(std::max(0.0, 1.0 - share) / hits));
  if (effect.id() == "outliers") {
    set("std_dps", effect.value(field_of(effect, "std_dps")) / std::sqrt(2.0 * hits));
  } else {
    const double run = effect.value(field_of(effect, "mean_run"));
    set("mean_run", std::sqrt(run * std::max(0.0, run - 1.0) / hits));
  }
  return errors;
}

}  // namespace gyrostat::gap
