#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gyrostat {

/// Standard normal deviates at addresses (seed, trial, stream, sample): no draw depends on another,
/// so adding a stream or a sample moves nothing else.
///
/// Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC11) gives four
/// 32-bit words per counter; Box-Muller turns them into four normals (largest magnitude 6.76).
/// Both, with logarithm, sine and cosine, are NormalBlocks, whose bits are the same on every
/// machine.
///
/// Example: the same deviate twice, and a block of a thousand.
///
///   const NormalStream noise(1, 17, "white noise");
///   const double first = noise.normal(0);
///   std::vector<double> block(1000);
///   noise.fill(0, block);
///   const bool same = block[0] == first;
///
/// Thread safety: it has no state but its address, so any number of threads may draw at once.
class NormalStream {
 public:
  NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream);

  /// The deviate at `sample`.
  double normal(std::uint64_t sample) const;
  /// The deviates at first, first + 1, ... into `out`; the same values as `normal`.
  void fill(std::uint64_t first, std::span<double> out) const;
  /// A uniform deviate on (0, 1) at `sample`. Shares words with `normal`: use one kind a stream.
  double uniform(std::uint64_t sample) const;

 private:
  std::uint64_t seed_;
  std::uint64_t stream_hash_;
  std::uint32_t trial_;
};

/// All noise of one trial.
struct Noise {
  std::uint64_t seed = 0;
  std::uint32_t trial = 0;

  NormalStream stream(std::string_view name) const { return {seed, trial, name}; }
};

}  // namespace gyrostat
