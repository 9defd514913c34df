#pragma once

#include <string_view>

namespace gyrostat::gap {

/// Where in the rate error an effect shows; of noise, slow is what the law remembers beyond lines.
enum class EffectBand { fast, slow, thermal, motion };
EffectBand band_of(std::string_view effect);
/// Of what warming does, too.
bool is_slow(std::string_view effect);

}  // namespace gyrostat::gap
