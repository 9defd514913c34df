#pragma once

#include <algorithm>
#include <cmath>

#include <gyrostat/diagnosis/diagnosed.hpp>
#include <gyrostat/diagnosis/starts/needs.hpp>
#include <gyrostat/diagnosis/starts/rest.hpp>
#include <gyrostat/diagnosis/starts/train_steps.hpp>
#include <gyrostat/generators/effects/quantization.hpp>

namespace gyrostat::gap {

/// The step is that of the values themselves; a fit to readings could only blur it.
template <>
struct Diagnosed<effects::Quantization> {
  static constexpr auto signature = Signature::none;
  static constexpr std::array<double effects::Quantization::*, 0> free_parameters = {};

  static std::vector<Start> starts(const Evidence& e) {
    std::vector<double> sorted;
    for (const auto& span : e.conditions().spans(Part::train))
      for (std::size_t i = span.first; i < span.last && sorted.size() < 50000; ++i)
        sorted.push_back(e.recording.gyro_dps[i]);
    std::sort(sorted.begin(), sorted.end());
    std::vector<double> gaps;
    const double least = std::max(1.5 * e.simulator.resolution_dps(), 1e-12);
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i] - sorted[i - 1] > least) gaps.push_back(sorted[i] - sorted[i - 1]);
    const double lsb =
        gaps.size() > 2 && gaps.size() < sorted.size() / 5 ? quantile(gaps, 0.2) : e.white_std_dps;
    const double rest = e.white_std_dps * e.white_std_dps - lsb * lsb / 12.0;
    return {
        {effects::Quantization{lsb}, with_white(e, std::sqrt(std::max(rest, 0.01 * lsb * lsb)))}};
  }

  static std::string why_not_assessable(const Conditions& c) { return needs::nothing(c); }

  static bool is_what_it_is_called(const effects::Quantization& /*effect*/,
                                   const Conditions& /*c*/) {
    return true;
  }
};

}  // namespace gyrostat::gap
