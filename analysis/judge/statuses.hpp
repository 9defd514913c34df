#pragma once

#include <array>

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::judge {

/// Steps of each Status, and when the first one broke down.
template <class T>
class Statuses {
 public:
  void add(const double* codes, const double* t_s, std::size_t samples) {
    if (!started_) first_s_ = Lanes<T>::load(t_s);
    started_ = true;
    T sum(0.0), most(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const T code = Lanes<T>::load(codes + k * Lanes<T>::count);
      sum += code;
      most = select(code > most, code, most);
    }
    steps_ += T(static_cast<double>(samples));
    if (any(most > T(missing)))
      add_others(codes, t_s, samples);
    else
      others_[0] += sum;  // as many as there are: each is 1
  }

  std::array<double, status_names.size()> steps_of_lane(int lane) const {
    std::array<double, status_names.size()> steps{};
    steps[0] = Lanes<T>::at(steps_, lane);
    for (std::size_t s = 1; s < status_names.size(); ++s) {
      steps[s] = Lanes<T>::at(others_[s - 1], lane);
      steps[0] -= steps[s];
    }
    return steps;
  }

  /// Since the first sample; NaN where none broke down.
  double first_breakdown_s(int lane) const { return Lanes<T>::at(breakdown_s_, lane); }

 private:
  static constexpr double missing = static_cast<double>(Status::no_measurement);
  static_assert(missing == 1.0);

  void add_others(const double* codes, const double* t_s, std::size_t samples) {
    for (std::size_t k = 0; k < samples; ++k) {
      const T code = Lanes<T>::load(codes + k * Lanes<T>::count);
      for (std::size_t s = 1; s < status_names.size(); ++s)
        others_[s - 1] += select(code == T(static_cast<double>(s)), T(1.0), T(0.0));
      const auto broken = code > T(missing);
      if (!any(broken)) continue;
      const T since_s = Lanes<T>::load(t_s + k * Lanes<T>::count) - first_s_;
      breakdown_s_ = select(broken && is_missing(breakdown_s_), since_s, breakdown_s_);
    }
  }

  T steps_{0.0};
  T others_[status_names.size() - 1] = {T(0.0), T(0.0), T(0.0), T(0.0)};
  T first_s_{0.0}, breakdown_s_{no_value};
  bool started_ = false;
};

}  // namespace gyrostat::judge
