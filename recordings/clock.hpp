#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A recording on an even clock, and in words what was done to it; no words where nothing was.
struct EvenRecording {
  Series series;
  std::string note;
};

/// Puts a recording on an even clock. Times that are even within 10 % of their median interval stay
/// as they are. Else the samples are regular and their stamps are not, in one of two ways:
///
/// - Samples were dropped: all but one interval in a hundred are a whole number of median
/// intervals,
///   give or take 0.3, and the clock that they add up to is off by no more than 0.2 % of the
///   duration. What is missing becomes NaN, in every channel but those that the sensor goes through
///   continuously (temperature, true rate, ...), which are interpolated.
/// - Stamps are those of arrival, in bursts: the times keep to a line over the samples' number
///   (Theil and Sen's, over pairs a third of the recording apart), where lost samples or a rate
///   that changes would have them wander off like a random walk. Sample k is then at its nominal
///   time.
///
/// Times become those of the line, whose scatter is told. Otherwise the rate itself changes, and
/// InputError names `--resample` as the remedy.
///
/// With `resample_hz` every sample goes to the nearest tick of an even clock of that rate: a tick
/// without one is missing, one with several has their mean, whose white noise is smaller; the noise
/// of all others is what it was, which interpolation would not leave it.
///
/// Throws InputError at `place` (sample 0 in line `first_row`, 0: no lines) as well where the clock
/// would have more than 2^27 ticks, or fewer than one tick in five hundred a sample.
EvenRecording evenly_sampled(Series series, std::string_view place, std::size_t first_row = 2,
                             double resample_hz = 0.0);

/// Throws InputError at `place` where fewer than one sample in four of an even clock is there, as
/// of short bursts with long pauses: no model of a series is told by that. It names the longest of
/// them, in seconds from a sample `from_s` before the first.
void require_dense(const Series& series, std::string_view place, double from_s = 0.0);

/// Whether every interval is within 10 % of the median one.
bool is_even(const std::vector<double>& t_s);

/// The median interval; of long recordings that of a few million, evenly spread.
double median_interval(const std::vector<double>& t_s);

}  // namespace gyrostat
