#pragma once

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/numerics/lanes.hpp>

namespace gyrostat {

/// How strongly a strong tracking filter forgets.
template <class T>
struct FadingParameters {
  T adaptive{1.0};
  T fading_factor{1.0};
  T forgetting{0.95};
  T softening{1.0};

  static constexpr auto fields() {
    using P = FadingParameters;
    return std::array{
        Field{"adaptive", &P::adaptive, "1", ranges::flag,
              "1: the factor follows the innovations; 0: it is fading_factor throughout"},
        Field{"fading_factor", &P::fading_factor, "1", ranges::at_least_one,
              "the fixed factor on the predicted covariance, or the least one when adaptive"},
        Field{"forgetting", &P::forgetting, "1", ranges::fraction,
              "rho, weight of the past in the innovation covariance V"},
        Field{"softening", &P::softening, "1", ranges::at_least_one,
              "beta, weakens the fading: N = V - H Q H^T - beta R"},
    };
  }
};

/// Fading factor of Zhou and Frank (1996), M measurements, from the traces of
/// N = V - H Q H^T - beta R and M = H F P F^T H^T, with V = eps eps^T at first and then
/// (rho V + eps eps^T) / (1 + rho). Only the trace of V is needed, so only that is kept.
template <class T>
class FadingFactor {
 public:
  explicit FadingFactor(const FadingParameters<T>& parameters) : parameters_(parameters) {}

  /// The factor for this step; 1, and nothing learnt, for an innovation that is not finite. Traces
  /// of eps eps^T, H Q H^T, R and H F P F^T H^T, all in dps^2.
  T next(const T& innovation, const T& process, const T& measurement, const T& predicted) {
    using std::isfinite;
    const Mask<T> learns = isfinite(innovation);
    const T& rho = parameters_.forgetting;
    const T spread = select(first_, innovation, T((rho * spread_ + innovation) / (T(1.0) + rho)));
    spread_ = select(learns, spread, spread_);
    first_ = first_ && !learns;
    const T& least = parameters_.fading_factor;
    const T factor = (spread_ - process - parameters_.softening * measurement) / predicted;
    const Mask<T> fades = parameters_.adaptive != T(0.0) && predicted > T(0.0) && factor > least;
    return select(learns, select(fades, factor, least), T(1.0));
  }

 private:
  FadingParameters<T> parameters_;
  T spread_{0.0};
  Mask<T> first_ = true;
};

}  // namespace gyrostat
