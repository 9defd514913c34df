#pragma once

#include <cstdint>
#include <vector>

#include <gyrostat/diagnosis/likelihood/noise_about_level.hpp>

namespace gyrostat::gap {

/// How many of the values that a grid has rounded, beside what is known of them, are not the one
/// that most of those about them are: what they say of anything but their level.
double share_off_their_neighbours(const std::vector<double>& rounded_dps,
                                  const std::vector<double>& known_dps, double lsb_dps);

/// The rate before it was rounded to a grid, drawn from its law given the rounded one by Gibbs'
/// sampler (Geman and Geman, IEEE Transactions PAMI 6, 1984): the level given the errors, each
/// error given the level, its neighbours and its cell of the grid. Fits to such draws, and draws
/// from what was fitted, in turn, lead to the likeliest law of what was rounded (stochastic EM:
/// Celeux and Diebolt, Computational Statistics Quarterly 2, 1985). On draws from one law another
/// gains, on average, no more than it does on what was rounded (Jensen's inequality).
class BeforeRounding {
 public:
  enum class Cells { alike, twice_as_wide_at_zero };
  /// Of `rounded_dps`, the middles of their cells, a value a sample, those that are missing or
  /// `unknown` (a flag a sample) say nothing. Either half of a wide cell stands for all of it.
  BeforeRounding(std::vector<double> rounded_dps, const std::vector<char>& unknown, double lsb_dps,
                 Cells cells = Cells::alike);

  /// Draws all samples anew, so many times, beside what of the rate is known (a value a sample).
  void draw(const NoiseAboutLevel& noise, const std::vector<double>& known_dps, int times);
  /// Under the law that such draws themselves have: an autoregression about the level, which walks
  /// as much as means of `cluster` samples do.
  void draw_under_own(const std::vector<double>& known_dps, std::size_t cluster, int times);
  /// The last draw; samples that say nothing are as they were.
  const std::vector<double>& rate_dps() const { return rate_; }

 private:
  void begin(const std::vector<double>& known_dps);
  void end(const std::vector<double>& known_dps);
  /// Noise of which nothing is seen.
  double least_dps2() const { return 1e-4 * lsb_ * lsb_; }
  /// Of what is known; gross errors are not drawn, nor do they say what noise is.
  void leave_out_far(const std::vector<double>& known_dps);
  NoiseAboutLevel own(std::size_t cluster) const;
  void draw_level(const NoiseAboutLevel& noise);
  void draw_errors(const NoiseAboutLevel& noise, const std::vector<double>& known_dps);

  std::vector<double> rounded_;
  double lsb_;
  Cells cells_;
  std::uint32_t draws_ = 0;
  std::vector<double> rate_, errors_, level_;
  std::vector<char> is_given_, is_known_;  ///< that do say something; and are not far off
};

}  // namespace gyrostat::gap
