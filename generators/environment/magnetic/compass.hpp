#pragma once

#include <vector>

#include <gyrostat/core/fields.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/series.hpp>

namespace gyrostat {

/// A period in which something magnetic stands near the compass.
struct MagneticDisturbance {
  double start_s = 0.0;
  double duration_s = 300.0;
  double offset_deg = 10.0;
  double noise_std_deg = 1.0;
  double flagged = 1.0;

  static constexpr auto fields() {
    using P = MagneticDisturbance;
    return std::array{
        Field{"start_s", &P::start_s, "s", ranges::non_negative, "when the disturbance begins"},
        Field{"duration_s", &P::duration_s, "s", ranges::positive, "how long it lasts"},
        Field{"offset_deg", &P::offset_deg, "deg", ranges::any, "heading error while it lasts"},
        Field{"noise_std_deg", &P::noise_std_deg, "deg", ranges::non_negative,
              "additional heading noise while it lasts"},
        Field{"flagged", &P::flagged, "1", ranges::flag,
              "1: mag_valid shows the disturbance; 0: nobody notices it"},
    };
  }
};

/// A magnetic compass: white noise on the true heading, and disturbance periods.
struct Compass {
  double noise_std_deg = 0.05;
  double initial_heading_deg = 0.0;
  std::vector<MagneticDisturbance> disturbances;

  static constexpr auto fields() {
    using P = Compass;
    return std::array{
        Field{"noise_std_deg", &P::noise_std_deg, "deg", ranges::non_negative,
              "standard deviation of the white heading noise, per sample"},
        Field{"initial_heading_deg", &P::initial_heading_deg, "deg", Range{.from = -180, .to = 180},
              "true heading at the first sample"},
    };
  }

  /// Fills heading_deg with the true heading from t_s and rate_ref_dps, not wrapped.
  void turn(Series& series) const;
  /// Adds white noise and disturbances to heading_deg, wraps it, and fills mag_valid. Streams
  /// "compass" and "compass/disturbance/0", "…/1", ….
  void read(Series& series, const Noise& noise) const;
  /// mag_valid at these times.
  std::vector<double> valid(const std::vector<double>& t_s) const;
  /// Turns and reads.
  void observe(Series& series, const Noise& noise) const;
};

}  // namespace gyrostat
