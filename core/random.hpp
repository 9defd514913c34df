#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gyrostat {

/// So many times the deviate that another trial has at the same address.
struct NoiseShare {
  std::uint32_t trial = 0;
  double weight = 1.0;
};

/// The deviates that were drawn of each stream, by sample; those that were not are 0.
using NoiseTape = std::map<std::string, std::vector<double>, std::less<>>;

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
/// Thread safety: it has no state but its address, so any number of threads may draw at once; one
/// with a tape belongs to one thread.
class NormalStream {
 public:
  NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream);
  /// Mixed of trials: each deviate is the sum of `shares` of theirs, a standard normal one again
  /// where the squares of the weights add up to 1, and of `shift` at its sample, as far as that
  /// goes. It is written to `tape`, if any. All three outlive the stream; no shares: `trial` alone,
  /// unshifted.
  NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream,
               std::span<const NoiseShare> shares, std::vector<double>* tape,
               std::span<const double> shift = {});

  /// The deviate at `sample`.
  double normal(std::uint64_t sample) const;
  /// The deviates at first, first + 1, ... into `out`; the same values as `normal`.
  void fill(std::uint64_t first, std::span<double> out) const;
  /// A uniform deviate on (0, 1) at `sample`. Shares words with `normal`: use one kind a stream. A
  /// mixed one is the probability below the normal deviate there, so that it moves with the shares.
  double uniform(std::uint64_t sample) const;

 private:
  double normal_of(std::uint32_t trial, std::uint64_t sample) const;
  void fill_of(std::uint32_t trial, std::uint64_t first, std::span<double> out) const;

  std::uint64_t seed_;
  std::uint64_t stream_hash_;
  std::uint32_t trial_;
  std::span<const NoiseShare> shares_{};
  std::span<const double> shift_{};
  std::vector<double>* tape_ = nullptr;
};

struct NormalAddress;

/// Where the deviates of a stream stand, for kernels that draw those of several trials at once.
NormalAddress address_of(std::uint64_t seed, std::string_view stream);

/// All noise of one trial, or of a mixture of trials.
struct Noise {
  std::uint64_t seed = 0;
  std::uint32_t trial = 0;
  std::span<const NoiseShare> shares{};  ///< none: `trial` alone; kept by who makes the noise
  NoiseTape* tape = nullptr;             ///< hears of every deviate; for one thread
  const NoiseTape* shift = nullptr;      ///< added to deviates that are mixed by shares
  std::string_view place{};              ///< before the names of streams, in tape and shift
  std::size_t twins = 0;                 ///< effects of the same kind before the one that it is for

  NormalStream stream(std::string_view name) const {
    std::string own;
    if (twins > 0) name = own = std::string(name) + ' ' + std::to_string(twins + 1);
    if (shares.empty() && tape == nullptr) return {seed, trial, name};
    const auto key = std::string(place).append(name);
    std::span<const double> added;
    if (shift != nullptr)
      if (const auto found = shift->find(key); found != shift->end()) added = found->second;
    return {seed, trial, name, shares, tape == nullptr ? nullptr : &(*tape)[key], added};
  }
};

}  // namespace gyrostat
