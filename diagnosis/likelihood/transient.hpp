#pragma once

#include <optional>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// What happens once, as a knock at the bench: for a moment a frequency has power that it has at no
/// other time.
struct Transient {
  double from_s, to_s;  ///< from the first sample; it is somewhere between
  double frequency_hz;
  double rms_dps;  ///< of its oscillation, there
  double p_value;  ///< family-wise: that of chance to show one as clear
};

/// The clearest one in a part of a sensor at rest, away from its lines: excess power in a tile of
/// time and frequency (Anderson, Brady, Creighton and Flanagan, Physical Review D 63, 2001,
/// 042003). Tiles are bins of tapered blocks that overlap by three quarters, of 32 samples to 4 s.
/// A bin is held to what it has in all other blocks, and a block to those around it or to the lower
/// quartile of its own bins, where it has 48 and that is more, or to what may leak from them:
/// neither a spectrum of any form is one, nor noise whose size changes within tens of seconds, nor
/// a spike or a step. Where the noise is normal the ratio is distributed as F or less. None of a
/// recording that turns or tilts: what is left of a motion comes and goes as it does.
std::optional<Transient> clearest_transient(const Conditions& conditions, Part part,
                                            const std::vector<double>& left_dps,
                                            const std::vector<Resonance>& lines);

}  // namespace gyrostat::gap
