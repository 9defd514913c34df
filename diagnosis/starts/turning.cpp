#include <gyrostat/diagnosis/starts/turning.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {

std::size_t quarter_second(const Series& recording) {
  return static_cast<std::size_t>(std::max(1.0, std::round(0.25 * recording.rate_hz())));
}

std::vector<double> quarter_second_means(const Series& recording,
                                         const std::vector<double>& rate_dps) {
  const auto length = static_cast<std::ptrdiff_t>(quarter_second(recording));
  std::vector<double> means;
  for (auto first = rate_dps.begin(); rate_dps.end() - first >= length; first += length)
    means.push_back(std::accumulate(first, first + length, 0.0) / static_cast<double>(length));
  return means;
}

double inner_extent(const std::vector<double>& values) {
  constexpr double aside = 0.01;
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known), [](double x) { return !is_missing(x); });
  if (known.empty()) return 0.0;
  return quantile(known, 1.0 - aside) - quantile(known, aside);
}

}  // namespace gyrostat::gap
