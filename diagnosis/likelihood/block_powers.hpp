#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>

namespace gyrostat::gap {

/// Periodograms of blocks that follow each other, over what noise shows in them on average: each
/// bin of normal noise is exponential, and independent of the others and of other blocks.
struct BlockPowers {
  std::size_t length = 0;      ///< samples of a block
  std::size_t first = 0;       ///< bin
  double resolution_hz = 0.0;  ///< from bin to bin
  double interval_s = 0.0;     ///< from block to block
  std::vector<double> noise_dps2{};
  /// Spans, their blocks, their bins; no bins where half of a block's samples are missing.
  std::vector<std::vector<std::vector<double>>> spans{};

  std::size_t bins() const { return noise_dps2.size(); }
  /// Blocks that have bins.
  std::size_t told() const;
  /// Log-likelihood of noise with `other` power in its bins, in what this noise shows, over that of
  /// this noise.
  double log_gain_of(const std::vector<double>& other) const;
};

/// Of the train part, within `reach_hz` of `centre_hz`.
BlockPowers block_powers(const Conditions& conditions, const std::vector<double>& left_dps,
                         const NoiseLaw& noise, std::size_t length, double centre_hz,
                         double reach_hz);

}  // namespace gyrostat::gap
