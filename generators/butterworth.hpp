#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace gyrostat {

/// Butterworth's low-pass filter by the bilinear transform, in sections of two poles, and one of a
/// single pole where their number is odd (Oppenheim and Schafer, "Discrete-Time Signal Processing",
/// 3rd ed., 7.2). A cutoff of half a cycle a sample or more takes nothing.
class Butterworth {
 public:
  Butterworth(double cycles_a_sample, std::size_t poles) {
    if (cycles_a_sample >= 0.5) return;
    const double k = std::tan(std::numbers::pi * cycles_a_sample);
    for (std::size_t j = 0; j < poles / 2; ++j) {
      const double angle = std::numbers::pi * (2.0 * static_cast<double>(j) + 1.0) /
                           (2.0 * static_cast<double>(poles));
      add_pair(k, std::sin(angle));
    }
    if (poles % 2 == 1)
      sections_.push_back({{k / (1.0 + k), k / (1.0 + k), 0.0}, {(k - 1.0) / (1.0 + k), 0.0}});
  }

  /// Two poles of that natural frequency and another damping instead (Butterworth's is 1/sqrt 2).
  static Butterworth damped(double cycles_a_sample, double damping_ratio) {
    Butterworth filter(cycles_a_sample, 0);
    if (cycles_a_sample < 0.5)
      filter.add_pair(std::tan(std::numbers::pi * cycles_a_sample), damping_ratio);
    return filter;
  }

  double operator()(double value) {
    for (auto& s : sections_) {  // direct form II transposed
      const double out = s.b[0] * value + s.state[0];
      s.state[0] = s.b[1] * value - s.a[0] * out + s.state[1];
      s.state[1] = s.b[2] * value - s.a[1] * out;
      value = out;
    }
    return value;
  }

 private:
  struct Section {
    std::array<double, 3> b;
    std::array<double, 2> a;
    std::array<double, 2> state{};
  };

  void add_pair(double k, double damping_ratio) {
    const double damping = 2.0 * damping_ratio * k;
    const double scale = 1.0 / (1.0 + damping + k * k);
    sections_.push_back({{k * k * scale, 2.0 * k * k * scale, k * k * scale},
                         {2.0 * (k * k - 1.0) * scale, (1.0 - damping + k * k) * scale}});
  }

  std::vector<Section> sections_;
};

}  // namespace gyrostat
