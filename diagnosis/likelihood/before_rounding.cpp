#include <gyrostat/diagnosis/likelihood/before_rounding.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <gyrostat/analysis/statistics/distributions.hpp>
#include <gyrostat/core/random.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::uint64_t seed = 1;

/// A normal value between two others, where the normal law has a share of `below` under it of what
/// it has between them.
double normal_between(double mean, double deviation, double low, double high, double share) {
  const double a = (low - mean) / deviation, b = (high - mean) / deviation;
  if (a > 0.0)
    return 2.0 * mean -
           normal_between(mean, deviation, 2.0 * mean - high, 2.0 * mean - low, 1.0 - share);
  constexpr double far = 30.0;  // where nothing is left of the law but how it falls
  if (b < -far) return std::max(low, high + deviation * std::log(share) / -b);
  const auto under = [](double x) { return normal_upper_tail(-x); };
  const double least = under(a), most = b > 0.0 ? 1.0 - under(-b) : under(b);
  const double at = least + share * (most - least);
  return std::clamp(mean + deviation * normal_quantile(std::clamp(at, 1e-300, 1.0 - 1e-16)), low,
                    high);
}

/// How far values are from the median of those about them.
std::vector<double> off_their_neighbours(const std::vector<double>& values) {
  constexpr std::size_t reach = 20;
  const std::size_t size = values.size();
  std::vector<double> off(size, no_value), about;
  for (std::size_t i = 0; i < size; ++i) {
    if (is_missing(values[i])) continue;
    about.clear();
    for (std::size_t k = i < reach ? 0 : i - reach; k < std::min(i + reach + 1, size); ++k)
      if (!is_missing(values[k])) about.push_back(values[k]);
    off[i] = std::abs(values[i] - quantile(about, 0.5));
  }
  return off;
}

/// A flag a sample: those that are there and not far off.
std::vector<char> near_their_neighbours(const std::vector<double>& values, double step) {
  constexpr double farthest = 6.0;
  const std::size_t size = values.size();
  const auto off = off_their_neighbours(values);
  std::vector<double> sizes;
  for (const double size_of_it : off)
    if (!is_missing(size_of_it)) sizes.push_back(size_of_it);
  std::vector<char> near(size, 0);
  if (sizes.empty()) return near;
  const double deviation = quantile(std::move(sizes), 0.5) / normal_quartile;
  const double most = step + farthest * std::max(deviation, step / std::sqrt(12.0));
  for (std::size_t i = 0; i < size; ++i) near[i] = off[i] <= most ? 1 : 0;
  return near;
}

}  // namespace

double share_off_their_neighbours(const std::vector<double>& rounded_dps,
                                  const std::vector<double>& known_dps, double lsb_dps) {
  auto errors = rounded_dps;
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= known_dps[i];
  double off = 0.0, count = 0.0;
  for (const double size : off_their_neighbours(errors))
    if (!is_missing(size)) {
      count += 1.0;
      off += size > 0.5 * lsb_dps ? 1.0 : 0.0;
    }
  return count > 0.0 ? off / count : 0.0;
}

BeforeRounding::BeforeRounding(std::vector<double> rounded_dps, const std::vector<char>& unknown,
                               double lsb_dps, Cells cells)
    : rounded_(std::move(rounded_dps)),
      lsb_(lsb_dps),
      cells_(cells),
      rate_(rounded_),
      errors_(rounded_.size(), 0.0),
      level_(rounded_.size(), 0.0),
      is_given_(rounded_.size(), 1),
      is_known_(rounded_.size(), 1) {
  for (std::size_t i = 0; i < rounded_.size(); ++i)
    if (is_missing(rounded_[i]) || unknown[i] != 0)
      is_given_[i] = 0;
    else if (cells_ == Cells::twice_as_wide_at_zero && std::abs(rounded_[i]) < 0.75 * lsb_)
      rounded_[i] = 0.0;
}

void BeforeRounding::begin(const std::vector<double>& known_dps) {
  std::vector<double> rounded(errors_.size(), no_value);
  for (std::size_t i = 0; i < errors_.size(); ++i)
    if (is_given_[i] != 0) rounded[i] = rounded_[i] - known_dps[i];
  is_known_ = near_their_neighbours(rounded, lsb_);
  for (std::size_t i = 0; i < errors_.size(); ++i)
    if (is_known_[i] != 0) errors_[i] = rate_[i] - known_dps[i];
}

void BeforeRounding::end(const std::vector<double>& known_dps) {
  for (std::size_t i = 0; i < errors_.size(); ++i)
    rate_[i] = is_known_[i] != 0 ? errors_[i] + known_dps[i] : rounded_[i];
}

void BeforeRounding::draw(const NoiseAboutLevel& noise, const std::vector<double>& known_dps,
                          int times) {
  begin(known_dps);
  if (draws_ > 0) leave_out_far(known_dps);
  for (int k = 0; k < times; ++k) {
    ++draws_;
    draw_level(noise);
    draw_errors(noise, known_dps);
  }
  end(known_dps);
}

void BeforeRounding::leave_out_far(const std::vector<double>& known_dps) {
  constexpr double farthest = 5.0;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < errors_.size(); ++i)
    if (is_known_[i] != 0) sizes.push_back(std::abs(errors_[i] - level_[i]));
  const double most = 0.5 * lsb_ + farthest / normal_quartile * quantile(std::move(sizes), 0.5);
  for (std::size_t i = 0; i < errors_.size(); ++i)
    if (is_known_[i] != 0 && std::abs(rounded_[i] - known_dps[i] - level_[i]) > most)
      is_known_[i] = 0;
}

NoiseAboutLevel BeforeRounding::own(std::size_t cluster) const {
  constexpr std::size_t longest = 16;
  const std::size_t size = errors_.size();
  std::vector<double> covariance(longest + 1, 0.0);
  for (std::size_t lag = 0; lag <= longest; ++lag) {
    for (std::size_t i = lag; i < size; ++i)
      covariance[lag] += (errors_[i] - level_[i]) * (errors_[i - lag] - level_[i - lag]);
    covariance[lag] /= static_cast<double>(size);
  }
  const auto fitted = autoregression(covariance);
  double squares = 0.0, steps = 0.0, before = 0.0;
  for (std::size_t first = 0; first + cluster <= size; first += cluster) {
    const auto begin = errors_.begin() + static_cast<std::ptrdiff_t>(first);
    const double mean = std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(cluster), 0.0) /
                        static_cast<double>(cluster);
    if (first > 0) squares += (mean - before) * (mean - before), steps += 1.0;
    before = mean;
  }
  return {.coefficients = fitted.coefficients,
          .innovation = fitted.errors.back(),
          .walk = steps > 0.0 ? 1.5 * squares / steps / static_cast<double>(cluster) : 0.0};
}

void BeforeRounding::draw_under_own(const std::vector<double>& known_dps, std::size_t cluster,
                                    int times) {
  constexpr int draws_of_a_law = 4;
  begin(known_dps);
  NoiseAboutLevel noise = own(cluster);
  noise.coefficients.clear();
  noise.innovation = lsb_ * lsb_ / 12.0;
  for (int k = 0; k < times; ++k) {
    if (k > 0 && k % draws_of_a_law == 0) {
      leave_out_far(known_dps);
      noise = own(cluster);
    }
    ++draws_;
    draw_level(noise);
    draw_errors(noise, known_dps);
  }
  end(known_dps);
}

/// Forward a Kalman filter of the local level model, backward a draw (Carter and Kohn, Biometrika
/// 81, 1994). To a level that walks slowly the noise is white.
void BeforeRounding::draw_level(const NoiseAboutLevel& noise) {
  const double sum = std::accumulate(noise.coefficients.begin(), noise.coefficients.end(), 1.0);
  const double white = std::max(noise.innovation / (sum * sum), least_dps2());
  const std::size_t size = errors_.size();
  std::vector<double> variances(size);
  double level = 0.0, variance = 1e6 * (white + noise.walk + lsb_ * lsb_);
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0) variance += noise.walk;
    if (is_known_[i] != 0) {
      const double gain = variance / (variance + white);
      level += gain * (errors_[i] - level);
      variance *= 1.0 - gain;
    }
    level_[i] = level;
    variances[i] = variance;
  }
  const NormalStream drawn(seed, draws_, "before rounding/level");
  for (std::size_t i = size; i-- > 0;) {
    double mean = level_[i], left = variances[i];
    if (i + 1 < size && noise.walk + left > 0.0) {
      const double gain = left / (left + noise.walk);
      mean += gain * (level_[i + 1] - mean);
      left *= 1.0 - gain;
    }
    level_[i] = mean + std::sqrt(left) * drawn.normal(i);
  }
}

void BeforeRounding::draw_errors(const NoiseAboutLevel& noise,
                                 const std::vector<double>& known_dps) {
  const std::size_t order = noise.coefficients.size(), size = errors_.size();
  std::vector<double> a = {1.0};
  a.insert(a.end(), noise.coefficients.begin(), noise.coefficients.end());
  std::vector<double> weights(order + 1, 0.0);  // of the noise's precision, by lag
  for (std::size_t lag = 0; lag <= order; ++lag)
    for (std::size_t k = 0; k + lag <= order; ++k) weights[lag] += a[k] * a[k + lag];
  const double deviation = std::sqrt(std::max(noise.innovation, least_dps2()) / weights[0]);
  const NormalStream drawn(seed, draws_, "before rounding/errors");
  std::vector<double> noises(size + 2 * order, 0.0);  // with nothing before and after
  for (std::size_t i = 0; i < size; ++i) noises[order + i] = errors_[i] - level_[i];
  for (std::size_t i = 0; i < size; ++i) {
    double mean = 0.0;
    const double* here = &noises[order + i];
    for (std::size_t lag = 1; lag <= order; ++lag)
      mean -= weights[lag] * (here[lag] + *(here - lag));
    mean = level_[i] + mean / weights[0];
    if (is_known_[i] != 0) {
      const double middle = rounded_[i] - known_dps[i];
      const bool is_wide = cells_ == Cells::twice_as_wide_at_zero && rounded_[i] == 0.0;
      const double reach = is_wide ? lsb_ : 0.5 * lsb_;
      errors_[i] =
          normal_between(mean, deviation, middle - reach, middle + reach, drawn.uniform(i));
    } else {
      errors_[i] = mean + deviation * normal_quantile(drawn.uniform(i));
    }
    noises[order + i] = errors_[i] - level_[i];
  }
}

}  // namespace gyrostat::gap
