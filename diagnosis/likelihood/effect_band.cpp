#include <gyrostat/diagnosis/likelihood/effect_band.hpp>

#include <gyrostat/diagnosis/cause_type.hpp>

namespace gyrostat::gap {

Band band_of(std::string_view id) {
  const auto& cause = cause_types().named(id, "effects");
  if (cause.signature == Signature::repeated && id != "sinusoidal") return Band::motion;
  if (cause.signature == Signature::slow) return Band::thermal;
  const auto stage = cause.effect().stage();
  return stage == Stage::noise || id == "vibration" || id == "vibration_bursts" ||
                 id == "wandering_line" || id == "sinusoidal"
             ? Band::fast
             : Band::slow;
}

bool is_slow(std::string_view id) {
  const auto band = band_of(id);
  return band == Band::slow || band == Band::thermal;
}

}  // namespace gyrostat::gap
