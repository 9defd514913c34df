#include <gyrostat/diagnosis/likelihood/two_exponentials.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gyrostat::gap {

double TwoExponentials::log_likelihood(const std::vector<double>& values) const {
  double sum = 0.0;
  for (const double q : values)
    sum += std::log(share_on / on * std::exp(-q / on) +
                    (1.0 - share_on) / off * std::exp(-q / off) + 1e-300);
  return sum;
}

TwoExponentials two_exponentials(const std::vector<double>& values, TwoExponentials start,
                                 double most_on, int passes) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  auto [share, on, off] = start;
  for (int pass = 0; pass < passes; ++pass) {
    double weight = 0.0, of_on = 0.0, of_off = 0.0;
    for (const double q : values) {
      const double odds = share / (1.0 - share) * off / on * std::exp(q / off - q / on);
      const double p = std::isfinite(odds) ? odds / (1.0 + odds) : 1.0;
      weight += p;
      of_on += p * q;
      of_off += (1.0 - p) * q;
    }
    share = std::clamp(weight / n, 1e-4, most_on);
    on = of_on / std::max(weight, 1e-9);
    off = std::max(of_off / std::max(n - weight, 1e-9), 1e-6 * mean);
  }
  return {share, on, off};
}

}  // namespace gyrostat::gap
