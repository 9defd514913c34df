#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <gyrostat/core/random.hpp>

namespace gyrostat {

/// A direction of the deviates, and how well it is known.
struct CommonDirection {
  NoiseTape unit;          ///< its components, of length 1 over all streams
  double closeness = 1.0;  ///< estimated cosine of its angle to what it stands for
};

/// Of the direction in which vectors lie that differ by noise from one to the next: the means of
/// failing trials, one of each independent run, whose noise of 10^5 deviates is far longer than
/// what they have in common. Each stream's mean is smoothed over its samples as much, and counted
/// as much, as brings it nearest to the vectors that it was not made of: the mean product of two
/// vectors is what they have in common, which noise does not bias. Nothing where that is not above
/// 0. `vectors` are at least two.
///
/// Example: ten deviates, of which all vectors have the first five in common.
///
///   std::vector<NoiseTape> vectors;
///   for (std::uint32_t k = 0; k < 4; ++k) {
///     auto& z = vectors.emplace_back()["z"];
///     z.resize(10);
///     NormalStream(1, k, "z").fill(0, z);
///     for (int i = 0; i < 5; ++i) z[i] += 3.0;
///   }
///   const auto direction = common_direction(vectors);
///   std::printf("%.2f\n", direction->closeness);
std::optional<CommonDirection> common_direction(std::span<const NoiseTape> vectors);

/// The component along it of a trial's deviates: of `noise` with what it has of shares and shift.
/// Those of streams at a `place` (a trial's own calibration) are drawn from `at_place`.
double along(const CommonDirection& direction, const Noise& noise, const Noise& at_place);

}  // namespace gyrostat
