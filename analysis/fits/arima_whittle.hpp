#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <gyrostat/core/models/arima111.hpp>

namespace gyrostat {

/// Half of a deviance up to a constant, with its gradient and expected information by (phi, delta1,
/// delta2, sqrt R).
struct ArimaMisfit {
  double value = 0.0;
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
};

/// The likelihood of ARIMA(1,1,1) + white noise as a recording's spectrum tells it (Whittle, Arkiv
/// for Matematik 2, 1953): ordinates of its periodogram are exponential about the model's density.
/// A model costs some hundred terms, however long the recording is, and the likeliest is within
/// about a standard error of that of the exact likelihood: it says where to look.
///
/// Ordinates are of Welch's periodograms, long ones at low frequencies and short ones above, meaned
/// over a sixteenth of a frequency; the lowest four, which a walk's own leakage fills, are left
/// out.
class ArimaWhittle {
 public:
  /// Samples of `rate_dps` may be missing. Without a stretch of `shortest` samples there are no
  /// terms.
  explicit ArimaWhittle(std::span<const double> rate_dps);

  static constexpr std::size_t shortest = std::size_t{1} << 15;

  bool has_terms() const { return !terms_.empty(); }
  ArimaMisfit about(const Arima111<double>& arima) const;
  /// About each of several.
  std::vector<ArimaMisfit> operator()(std::span<const Arima111<double>> models) const;

 private:
  struct Term {
    double cosine;   ///< of the angular frequency
    double density;  ///< dps^2, two-sided, at one sample a second
    double weight;   ///< ordinates of a periodogram of all samples
  };
  void add_terms(const std::vector<double>& density, std::size_t length, std::size_t from,
                 std::size_t to, double samples);

  std::vector<Term> terms_;
};

}  // namespace gyrostat
