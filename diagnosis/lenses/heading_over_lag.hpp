#pragma once

#include <gyrostat/diagnosis/gap/lens.hpp>

namespace gyrostat::gap::lenses {

/// Regression coefficient, seconds, of the heading error on the reference rate so many seconds
/// before: a slow compass trails the turn.
struct HeadingOverLag : Lens {
  static constexpr std::string_view title = "heading error against past rate";
  static constexpr std::string_view channel = "heading_deg";
  static constexpr std::string_view coordinate = "time_s";
  static constexpr std::string_view unit = "s";

  HeadingOverLag(const Conditions& seen, Part seen_part) : Lens(seen, seen_part) {
    if (!seen.has_heading() || !seen.has_motion()) return;
    for (const double lag_s : {0.0, 0.1, 0.3, 1.0, 3.0}) {
      lags_.push_back(static_cast<std::size_t>(std::lround(lag_s / seen.interval_s())));
      at.push_back({lag_s, lag_s});
    }
    for (const auto& span : spans())
      for (std::size_t i = span.first; i < span.last; ++i)
        energy_ += std::pow(seen.series().rate_ref_dps[i], 2);
    if (energy_ == 0.0) at.clear();
  }

  void read(const Scene& scene, std::span<double> out) const {
    auto reading = out.begin();
    const auto& rate = conditions->series().rate_ref_dps;
    for (const std::size_t lag : lags_) {
      double product = 0.0;
      for (const auto& span : spans())
        for (std::size_t i = span.first + lag; i < span.last; ++i)
          if (!is_missing(scene.heading_error_deg[i]))
            product += rate[i - lag] * scene.heading_error_deg[i];
      *reading++ = product / energy_;
    }
  }

 private:
  std::vector<std::size_t> lags_;
  double energy_ = 0.0;
};

}  // namespace gyrostat::gap::lenses
