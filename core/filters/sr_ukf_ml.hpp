#pragma once

#include <gyrostat/core/filters/kf_rml.hpp>
#include <gyrostat/core/models/nl_unscented.hpp>

namespace gyrostat::filters {

template <class T>
struct SrUkfMlParameters : KfRmlParameters<T>, UnscentedParameters<T> {
  static constexpr auto fields() {
    return join_fields<SrUkfMlParameters, T>(KfRmlParameters<T>::fields(),
                                             UnscentedParameters<T>::fields());
  }
};

/// SrUkf whose delta1, delta2 and R do learn, which model NL alone cannot [A eq. 5]: before each
/// sample they are set to what recursive maximum likelihood (KfRml, run beside it) has made of the
/// samples before. Their doubt is the learner's, so the sigma points take them as known; phi stays
/// a state of the filter's own. Without initial doubt about them it is SrUkf.
template <class T>
class SrUkfMl {
 public:
  using Scalar = T;
  using Parameters = SrUkfMlParameters<T>;
  static constexpr std::string_view title =
      "SR-UKF on model NL with delta1, delta2 and R by recursive maximum likelihood";
  static constexpr Needs needs{};
  static constexpr Role role{};

  explicit SrUkfMl(const Parameters& p) : learner_(p), filter_(at_start(p)) {}

  Step<T> step(const Sample<T>& sample) {
    const auto model = learner_.model();
    filter_.set_noise(model.delta1_dps, model.delta2_dps, model.measurement_noise_std_dps);
    learner_.step(sample);
    return nl_cycle<T>(filter_, sample.gyro_dps);
  }

  const NlUnscented<T>& state() const { return filter_; }
  LearnedParameters learned() const requires std::same_as<T, double> {
    auto learned = filter_.learned();
    learned.delta1_dps = learner_.model().delta1_dps;
    learned.delta2_dps = learner_.model().delta2_dps;
    return learned;
  }

 private:
  static NlParameters<T> at_start(const Parameters& p) {
    NlParameters<T> start;
    static_cast<RandomErrorParameters<T>&>(start) = p;
    static_cast<UnscentedParameters<T>&>(start) = p;
    start.initial_phi_std = p.initial_phi_std;
    start.initial_delta1_std_dps = start.initial_delta2_std_dps = T(0.0);
    return start;
  }

  KfRml<T> learner_;
  NlUnscented<T> filter_;
};

}  // namespace gyrostat::filters
