#pragma once

#include <gyrostat/core/models/nl_unscented.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat::filters {

/// Risk parameters mu = diag(mu_1 ... mu_7) of the states of model NL.
template <class T>
struct RiskParameters {
  T mu_x{0.0};
  T mu_x_previous{0.0};
  T mu_phi{0.02};
  T mu_delta1{0.0};
  T mu_delta2{0.0};
  T mu_a{0.0};
  T mu_a_previous{0.0};

  static constexpr auto fields() {
    using P = RiskParameters;
    return std::array{
        Field{"mu_x", &P::mu_x, "1/dps²", ranges::non_negative, "risk parameter of x_k"},
        Field{"mu_x_previous", &P::mu_x_previous, "1/dps²", ranges::non_negative,
              "risk parameter of x_{k-1}"},
        Field{"mu_phi", &P::mu_phi, "1", ranges::non_negative, "risk parameter of phi"},
        Field{"mu_delta1", &P::mu_delta1, "1/dps²", ranges::non_negative,
              "risk parameter of delta1"},
        Field{"mu_delta2", &P::mu_delta2, "1/dps²", ranges::non_negative,
              "risk parameter of delta2"},
        Field{"mu_a", &P::mu_a, "1", ranges::non_negative, "risk parameter of the noise a_k"},
        Field{"mu_a_previous", &P::mu_a_previous, "1", ranges::non_negative,
              "risk parameter of the noise a_{k-1}"},
    };
  }

  Vector<T, 7> diagonal() const {
    Vector<T, 7> mu;
    mu << mu_x, mu_x_previous, mu_phi, mu_delta1, mu_delta2, mu_a, mu_a_previous;
    return mu;
  }
};

template <class T>
struct SrRsukfParameters : NlParameters<T>, RiskParameters<T> {
  static constexpr auto fields() {
    return join_fields<SrRsukfParameters, T>(NlParameters<T>::fields(),
                                             RiskParameters<T>::fields());
  }
};

/// Square-root risk-sensitive unscented Kalman filter on model NL, method 3 of [A]: after the time
/// update P <- (P^-1 - 2 mu)^-1, which keeps the gain of a doubted model open. Where that does not
/// exist the step goes on without it as `risk_breakdown`. mu = 0 is the SR-UKF.
template <class T>
class SrRsukf {
 public:
  using Scalar = T;
  using Parameters = SrRsukfParameters<T>;
  static constexpr std::string_view title =
      "square-root risk-sensitive unscented Kalman filter on model NL";
  static constexpr Needs needs{};
  static constexpr Role role{.published = 4};
  static constexpr bool packs_trials = true;

  explicit SrRsukf(const Parameters& p) : filter_(p), risk_(p.diagonal()) {}

  Step<T> step(const Sample<T>& sample) { return nl_cycle<T>(filter_, sample.gyro_dps, &risk_); }

  const NlUnscented<T>& state() const { return filter_; }
  Learned<T> learned() const { return filter_.learned(); }

 private:
  NlUnscented<T> filter_;
  NlRisk<T> risk_;
};

}  // namespace gyrostat::filters
