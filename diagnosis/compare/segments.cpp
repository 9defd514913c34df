#include <gyrostat/diagnosis/compare/segments.hpp>

#include <algorithm>

#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/gap/scene.hpp>

namespace gyrostat::gap {
namespace {

/// Whether enough is there; then with lines over what is not.
bool bridged(std::vector<double>& values) {
  constexpr std::size_t most_missing = 50;
  const auto missing =
      std::count_if(values.begin(), values.end(), [](double v) { return is_missing(v); });
  if (static_cast<std::size_t>(missing) * most_missing > values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_missing(values[i])) continue;
    std::size_t end = i;
    while (end < values.size() && is_missing(values[end])) ++end;
    const double after = end < values.size() ? values[end] : values[i - 1];
    const double before = i > 0 ? values[i - 1] : after;
    const auto steps = static_cast<double>(end - i + 1);
    for (std::size_t k = i; k < end; ++k)
      values[k] = before + (after - before) * static_cast<double>(k - i + 1) / steps;
    i = end;
  }
  return true;
}

}  // namespace

SegmentReader::SegmentReader(double rate_hz, std::size_t samples) : samples_(samples) {
  Series series;
  series.t_s.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) series.t_s[i] = static_cast<double>(i) / rate_hz;
  series.gyro_dps.resize(samples);
  NormalStream(1, 0, "segment").fill(0, series.gyro_dps);  // any values: only their times count
  conditions_ = std::make_unique<const Conditions>(series, Split::none);
  instrument_ = std::make_unique<const Instrument>(*conditions_, Part::train);
}

Eigen::VectorXd SegmentReader::read(std::span<const double> error_dps) const {
  Series series;
  series.t_s = conditions_->series().t_s;
  series.gyro_dps.assign(error_dps.begin(), error_dps.end());
  return instrument_->read(Scene(*conditions_, series, train_alone));
}

std::size_t longest_segment(const Conditions& conditions) {
  return conditions.size() / Conditions::blocks - 2 * conditions.cluster();
}

std::vector<std::vector<double>> segments_of(const Conditions& conditions,
                                             const std::vector<double>& error_dps, Part part,
                                             std::size_t samples) {
  std::vector<std::vector<double>> found;
  const std::size_t size = conditions.size();
  for (std::size_t block = 0; block < Conditions::blocks; ++block) {
    const std::size_t first = block * size / Conditions::blocks + conditions.cluster();
    const std::size_t last = (block + 1) * size / Conditions::blocks - conditions.cluster();
    if (conditions.part_of((first + last) / 2) != part) continue;
    for (std::size_t at = first; at + samples <= last; at += samples) {
      std::vector<double> values(error_dps.begin() + static_cast<std::ptrdiff_t>(at),
                                 error_dps.begin() + static_cast<std::ptrdiff_t>(at + samples));
      if (bridged(values)) found.push_back(std::move(values));
    }
  }
  return found;
}

}  // namespace gyrostat::gap
