#include <gyrostat/diagnosis/likelihood/effect_band.hpp>

#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/likelihood/effect_values.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/diagnosis/starts/slow_noise.hpp>

namespace gyrostat::gap {

EffectBand band_of(std::string_view id) {
  const auto& cause = cause_types().named(id, "effects");
  if (cause.signature == Signature::repeated && id != "sinusoidal") return EffectBand::motion;
  if (cause.signature == Signature::slow) return EffectBand::thermal;
  if (cause.enter == nullptr) return EffectBand::fast;
  NoiseLaw law{.interval_s = 0.01, .duration_s = 3600.0};  // any that is long beside it
  cause.enter(cause.effect(), law);
  return law.walk > 0.0 || law.jumps || !law.decaying.empty() ? EffectBand::slow : EffectBand::fast;
}

EffectBand band_of(const Effect& effect, const Conditions& conditions) {
  return effect.id() == "gauss_markov" &&
                 !is_slow(effect.value(field_of(effect, "correlation_time_s")), conditions)
             ? EffectBand::fast
             : band_of(effect.id());
}

bool is_line(std::string_view id) { return id == "vibration" || id == "wandering_line"; }

bool is_noise_filter(std::string_view id) {
  return id == "noise_bandwidth" || id == "noise_averaging";
}

bool is_slow(std::string_view id) {
  const auto band = band_of(id);
  return band == EffectBand::slow || band == EffectBand::thermal;
}

}  // namespace gyrostat::gap
