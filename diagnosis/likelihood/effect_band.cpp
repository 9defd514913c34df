#include <gyrostat/diagnosis/likelihood/effect_band.hpp>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {

EffectBand band_of(std::string_view id) {
  const auto& cause = cause_types().named(id, "effects");
  if (cause.signature == Signature::repeated && id != "sinusoidal") return EffectBand::motion;
  if (cause.signature == Signature::slow) return EffectBand::thermal;
  const auto stage = cause.effect().stage();
  return stage == Stage::noise || id == "vibration" || id == "vibration_bursts" ||
                 id == "wandering_line" || id == "sinusoidal"
             ? EffectBand::fast
             : EffectBand::slow;
}

bool is_slow(std::string_view id) {
  const auto band = band_of(id);
  return band == EffectBand::slow || band == EffectBand::thermal;
}

}  // namespace gyrostat::gap
