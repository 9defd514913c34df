#pragma once

#include <string_view>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/generators/effect.hpp>

namespace gyrostat::gap {

/// Where in the rate error an effect shows; of noise, slow is what the law remembers beyond lines.
enum class EffectBand { fast, slow, thermal, motion };
EffectBand band_of(std::string_view effect);
/// A process that lasts for a few samples is fast, beside what filters make of white noise.
EffectBand band_of(const Effect& effect, const Conditions& conditions);
/// Noise in a narrow band, which of whose names it has is told by its envelope.
bool is_line(std::string_view effect);
/// Colours the noise.
bool is_noise_filter(std::string_view effect);
/// Of what warming does, too.
bool is_slow(std::string_view effect);

}  // namespace gyrostat::gap
