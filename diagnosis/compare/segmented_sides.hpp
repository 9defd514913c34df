#pragma once

#include <array>
#include <memory>
#include <vector>

#include <gyrostat/diagnosis/compare/matched.hpp>
#include <gyrostat/diagnosis/compare/segments.hpp>
#include <gyrostat/diagnosis/compare/studied_side.hpp>
#include <gyrostat/diagnosis/compare/two_samples.hpp>

namespace gyrostat::gap {

/// Both sides as segments, read by the lenses: the train parts for tests, pieces of the held-out
/// parts for the gap. The simulated ones as they are, or with an addition. Values of both are
/// rounded alike, to the coarser resolution. Outlives neither side.
class SegmentedSides {
 public:
  /// Throws InputError where too much is missing for three segments a side.
  SegmentedSides(const StudiedSide& real, const StudiedSide& simulated, const Matched& matched,
                 std::uint64_t seed);

  std::size_t real_count() const { return static_cast<std::size_t>(real_.cols()); }
  std::size_t simulated_count() const { return static_cast<std::size_t>(simulated_.cols()); }

  TwoSamples test(const Addition& addition = {}) const;
  /// The readings by which the test tells the sides apart.
  std::vector<Where> departures(const TwoSamples& test) const;
  /// Means and spreads of a segment's readings, the simulated ones before and after.
  std::vector<Band> bands(const Addition& addition) const;
  /// How often louder noise would be found at a level.
  std::vector<Power> power(double level) const;

  double gap(const Addition& addition = {}) const;
  /// 95 % interval of the share that the addition closes of it.
  std::array<double, 2> closed(const Addition& addition) const;
  Series mended(std::size_t trace, const Addition& addition) const;

 private:
  using Segments = std::vector<std::vector<double>>;
  Segments segments(const StudiedSide& side, Part part, std::size_t samples,
                    const Addition& addition) const;
  /// Of the simulated side with that added.
  Eigen::MatrixXd train(const Addition& addition) const;
  Eigen::MatrixXd held_out(const Addition& addition) const;

  const StudiedSide &real_side_, &simulated_side_;
  std::uint64_t seed_;
  double resolution_dps_;
  SegmentReader whole_, piece_;
  Eigen::MatrixXd real_, simulated_;
  std::unique_ptr<const SegmentGap> gap_;
};

}  // namespace gyrostat::gap
