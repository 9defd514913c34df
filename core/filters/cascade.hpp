#pragma once

#include <gyrostat/core/filters/sr_rsukf.hpp>
#include <gyrostat/core/filters/thermal_stf.hpp>

namespace gyrostat::filters {

/// All that the two filters are told, but for the level of x: it starts at zero, since the level of
/// the gyro's error is the thermal part's.
template <class T>
struct CascadeParameters : ThermalStfParameters<T>, SrRsukfParameters<T> {
  static constexpr auto fields() {
    using P = CascadeParameters;
    return join_fields<P, T>(
        ThermalStfParameters<T>::fields(), Arima111<T>::fields(),
        std::array{
            Field{"initial_x_std_dps", &P::initial_x_std_dps, "dps", ranges::non_negative,
                  "initial standard deviation of x_k"},
            Field{"initial_x_previous_std_dps", &P::initial_x_previous_std_dps, "dps",
                  ranges::non_negative, "initial standard deviation of x_{k-1}"},
        },
        InitialParameterStates<T>::fields(), UnscentedParameters<T>::fields(),
        RiskParameters<T>::fields());
  }
};

/// ThermalStf and, on what it leaves, SrRsukf: the estimate is the sum. The thermal part goes by
/// the compass, which motion does not disturb; the fast part by the rate alone. Their variances
/// add, as of independent errors; a breakdown of the thermal part comes before the status of the
/// fast one, whose innovation is reported.
template <class T>
class Cascade {
 public:
  using Scalar = T;
  using Parameters = CascadeParameters<T>;
  static constexpr std::string_view title = "thermal STF and SR-RSUKF on what it leaves";
  static constexpr Needs needs{.temperature = true, .heading = true};
  static constexpr Role role{.corrects = Role::Corrects::thermal_drift};

  explicit Cascade(const Parameters& p) : thermal_(p), fast_(p) {}

  Step<T> step(Sample<T> sample) {
    const Step<T> thermal = thermal_.step(sample);
    sample.gyro_dps -= thermal.estimate_dps;
    Step<T> step = fast_.step(sample);
    step.estimate_dps += thermal.estimate_dps;
    step.estimate_variance += thermal.estimate_variance;
    if (is_breakdown(thermal.status)) step.status = thermal.status;
    return step;
  }

  LearnedParameters learned() const requires std::same_as<T, double> { return fast_.learned(); }

 private:
  ThermalStf<T> thermal_;
  SrRsukf<T> fast_;
};

}  // namespace gyrostat::filters
