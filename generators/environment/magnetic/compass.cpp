#include <gyrostat/generators/environment/magnetic/compass.hpp>

#include <string>

#include <gyrostat/generators/random_error.hpp>

namespace gyrostat {

void Compass::turn(Series& series) const {
  auto& heading = series.heading_deg;
  heading.assign(series.size(), initial_heading_deg);
  for (std::size_t i = 1; i < heading.size(); ++i)
    heading[i] = heading[i - 1] + series.rate_ref_dps[i] * (series.t_s[i] - series.t_s[i - 1]);
}

std::vector<double> Compass::valid(const std::vector<double>& t_s) const {
  std::vector<double> valid(t_s.size(), 1.0);
  for (const auto& d : disturbances)
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      const double into = t_s[i] - d.start_s;
      if (d.flagged != 0.0 && into >= 0.0 && into < d.duration_s) valid[i] = 0.0;
    }
  return valid;
}

void Compass::read(Series& series, const Noise& noise) const {
  auto& heading = series.heading_deg;
  series.mag_valid = valid(series.t_s);
  add_white_noise(noise_std_deg, noise.stream("compass"), heading);

  for (std::size_t n = 0; n < disturbances.size(); ++n) {
    const auto& d = disturbances[n];
    const auto stream = noise.stream("compass/disturbance/" + std::to_string(n));
    for (std::size_t i = 0; i < heading.size(); ++i) {
      const double into = series.t_s[i] - d.start_s;
      if (into < 0.0 || into >= d.duration_s) continue;
      heading[i] += d.offset_deg + d.noise_std_deg * stream.normal(i);
    }
  }
  for (auto& angle : heading) angle = wrap_degrees(angle);
}

void Compass::observe(Series& series, const Noise& noise) const {
  turn(series);
  read(series, noise);
}

}  // namespace gyrostat
