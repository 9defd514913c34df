#pragma once

#include <gyrostat/diagnosis/likelihood/histories/jump_histories.hpp>

namespace gyrostat::gap {

/// The kernel of an instruction set.
template <class Target>
struct JumpsOf {
  template <int N>
  static double followed(const JumpLaw& law, const std::size_t* points, const double* values,
                         std::size_t count, double* said) {
    using Histories = JumpHistories<Target, N>;
    typename Histories::Trail trail(said);
    Histories histories(law, said != nullptr ? &trail : nullptr);
    double log_likelihood = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      if (k > 0) histories.predict(points[k] - points[k - 1]);
      const double log_density = histories.update(values[k]);
      if (k > 0) log_likelihood += log_density;
      histories.reduce();
      histories.settle(k + 1 == count);
    }
    return log_likelihood;
  }

  /// With the least room that the law's states need.
  static double follow(const JumpLaw& law, const std::size_t* points, const double* values,
                       std::size_t count, double* said) {
    const auto call = law.states <= 1   ? &followed<1>
                      : law.states == 2 ? &followed<2>
                      : law.states == 3 ? &followed<3>
                      : law.states <= 9 ? &followed<9>
                                        : &followed<most_states>;
    return call(law, points, values, count, said);
  }
};

}  // namespace gyrostat::gap
