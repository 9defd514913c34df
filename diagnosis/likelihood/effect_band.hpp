#pragma once

#include <string_view>

namespace gyrostat::gap {

/// Where in the rate error an effect shows; of noise, slow is what the law remembers beyond lines.
enum class EffectBand { fast, slow, thermal, motion };
EffectBand band_of(std::string_view effect);
/// Noise in a narrow band, which of whose names it has is told by its envelope.
bool is_line(std::string_view effect);
/// Of what warming does, too.
bool is_slow(std::string_view effect);

}  // namespace gyrostat::gap
