#pragma once

#include <gyrostat/diagnosis/likelihood/line_track.hpp>
#include <gyrostat/diagnosis/likelihood/set_bench.hpp>

namespace gyrostat::gap {

/// An envelope, or a track, that is so many times likelier than that of normal noise, as a
/// logarithm.
inline constexpr double clear_shape = 4.0;

/// In the place of a resonance: as its track says where that tells it, or the likelier of both,
/// fitted.
Standing with_wandering_line(const SetBench& bench, const Standing& standing, std::size_t at,
                             const LineTrack& track);
/// In the place of a line that wanders, fitted.
Standing with_resonance(const SetBench& bench, const Standing& standing, std::size_t at);
/// With one more, fitted.
Standing with_line(const SetBench& bench, Standing standing, const Effect& line);
/// Of a line that wanders slowly the spectrum says where it was, not for how long: it has been
/// through its band so many times, or its simulations would differ by where they begin.
void hold_within(const Conditions& conditions, Effect& line);

}  // namespace gyrostat::gap
