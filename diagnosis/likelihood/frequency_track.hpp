#pragma once

#include <vector>

#include <gyrostat/diagnosis/likelihood/block_powers.hpp>

namespace gyrostat::gap {

/// How a frequency goes from block to block: as a Gauss-Markov process about a mean, or without one
/// anywhere, by steps.
struct Wandering {
  double centre_hz = 0.0, std_hz = 0.0;
  double memory_blocks = 1.0;

  static Wandering anywhere(double step_hz) { return {0.0, step_hz, 0.0}; }
  bool is_anywhere() const { return memory_blocks == 0.0; }
  /// Standard deviation of the frequency given the one before.
  double step_hz() const;
};

/// A sine of constant power in noise, whose frequency is a hidden Markov chain over half bins
/// (Streit and Barrett, "Frequency line tracking using hidden Markov models", IEEE Trans. ASSP 38,
/// 1990).
class FrequencyTrack {
 public:
  FrequencyTrack(const BlockPowers& blocks, const Wandering& wandering);

  /// Log-likelihood of a sine with `power` in each bin, in the noise's, over that of the noise
  /// alone: summed over all tracks.
  double log_gain(const std::vector<double>& power) const;
  /// Noise and, of such a sine, what each bin shows on average over all tracks, in the noise's.
  std::vector<double> spectrum(const std::vector<double>& power) const;
  /// Where the frequency is and how it wanders, given all blocks.
  Wandering seen(const std::vector<double>& power) const;

 private:
  /// Probabilities of the states from one on.
  struct Row {
    std::size_t from = 0;
    std::vector<double> probabilities;
  };

  double frequency_hz(std::size_t state) const {
    return blocks_.resolution_hz *
           (static_cast<double>(blocks_.first) + 0.5 * static_cast<double>(state));
  }
  std::vector<double> moved(const std::vector<double>& states) const;
  /// States before and after each block of a span is seen; the log-likelihood that it gains.
  template <class Visit>
  double forward(const std::vector<std::vector<double>>& span, const std::vector<double>& power,
                 const Visit& visit) const;

  const BlockPowers& blocks_;
  std::vector<double> first_;
  std::vector<Row> next_;
};

}  // namespace gyrostat::gap
