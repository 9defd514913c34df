#include <gyrostat/analysis/sensitivity/crossed_rows.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <gyrostat/core/random.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t least_rows = 4;

std::vector<double> means_of(const CrossedRows& rows) {
  std::vector<double> means(rows.components(), 0.0);
  for (std::size_t r = 0; r < rows.rows(); ++r)
    for (std::size_t c = 0; c < means.size(); ++c) means[c] += rows.row(r)[c];
  for (double& m : means) m /= static_cast<double>(rows.rows());
  return means;
}

/// Central differences, a thousandth of each component's own spread over rows wide.
std::vector<double> gradient(const OfMeans& statistic, const std::vector<double>& means,
                             const std::vector<double>& widths) {
  std::vector<double> slopes(means.size(), 0.0);
  for (std::size_t c = 0; c < means.size(); ++c) {
    const double step = 1e-4 * widths[c];
    if (step == 0.0) continue;
    auto above = means, below = means;
    above[c] += step;
    below[c] -= step;
    slopes[c] = (statistic(above) - statistic(below)) / (2.0 * step);
  }
  return slopes;
}

/// What each trial does to the statistic, beyond what the trials of single cells would do by
/// chance.
struct SharedNoise {
  std::vector<double> influences;  ///< by trial, zero on average
  double variance = 0.0;           ///< that they give the statistic
};

SharedNoise shared_noise(const CrossedRows& rows, const std::vector<double>& slopes) {
  const auto n = static_cast<double>(rows.rows()), T = static_cast<double>(rows.trials());
  SharedNoise shared{std::vector<double>(rows.trials(), 0.0), 0.0};
  if (rows.trials() < 2) return shared;
  double cells = 0.0;
  std::vector<double> own(rows.trials());
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    double mean = 0.0;
    for (std::size_t t = 0; t < rows.trials(); ++t) {
      const auto without = rows.without(r, t);
      own[t] = 0.0;
      for (std::size_t c = 0; c < slopes.size(); ++c) own[t] += slopes[c] * without[c];
      mean += own[t] / T;
    }
    for (std::size_t t = 0; t < rows.trials(); ++t) {
      const double influence = (T - 1.0) * (mean - own[t]) / n;
      shared.influences[t] += influence;
      cells += influence * influence;
    }
  }
  const double all = std::inner_product(shared.influences.begin(), shared.influences.end(),
                                        shared.influences.begin(), 0.0);
  const double share = all > 0.0 ? std::max(0.0, 1.0 - cells / all) : 0.0;
  for (double& influence : shared.influences) influence *= std::sqrt(share * T / (T - 1.0));
  shared.variance = share * all / (T * (T - 1.0));
  return shared;
}

/// The quantile of sorted values that has `share` of them below it.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() + 1) - 1.0;
  return sorted[static_cast<std::size_t>(
      std::clamp(at, 0.0, static_cast<double>(sorted.size() - 1)))];
}

/// A statistic of resampled rows, and the variance that its rows give it.
struct Resampled {
  double value = 0.0, variance = 0.0;
};

/// The rows about their means, ready to be resampled.
class Rows {
 public:
  Rows(const CrossedRows& rows, const OfMeans& statistic)
      : statistic_(statistic),
        means_(means_of(rows)),
        size_(rows.rows()),
        centred_(size_ * means_.size()),
        widths_(means_.size(), 0.0),
        once_(size_, 1) {
    for (std::size_t r = 0; r < size_; ++r)
      for (std::size_t c = 0; c < means_.size(); ++c) {
        const double d = centred_[r * means_.size() + c] = rows.row(r)[c] - means_[c];
        widths_[c] += d * d;
      }
    for (double& w : widths_) w = std::sqrt(w) / static_cast<double>(size_);
  }

  Resampled all() const { return resampled(once_); }
  std::vector<double> slopes() const { return gradient(statistic_, means_, widths_); }

  /// Each row as often as `counts` says.
  Resampled resampled(std::span<const std::uint16_t> counts) const {
    const std::size_t C = means_.size();
    const auto n = static_cast<double>(size_);
    std::vector<double> sums(C, 0.0), products(C * C, 0.0);
    for (std::size_t r = 0; r < size_; ++r) {
      if (counts[r] == 0) continue;
      const double* row = &centred_[r * C];
      for (std::size_t c = 0; c < C; ++c) {
        const double times = counts[r] * row[c];
        sums[c] += times;
        for (std::size_t d = 0; d <= c; ++d) products[c * C + d] += times * row[d];
      }
    }
    auto at = means_;
    for (std::size_t c = 0; c < C; ++c) at[c] += sums[c] / n;
    const auto slopes_there = gradient(statistic_, at, widths_);
    double variance = 0.0;
    for (std::size_t c = 0; c < C; ++c)
      for (std::size_t d = 0; d <= c; ++d)
        variance += (c == d ? 1.0 : 2.0) * slopes_there[c] * slopes_there[d] *
                    (products[c * C + d] - sums[c] * sums[d] / n);
    return {statistic_(at), std::max(0.0, variance) / (n * (n - 1.0))};
  }

 private:
  const OfMeans& statistic_;
  std::vector<double> means_;
  std::size_t size_;
  std::vector<double> centred_, widths_;
  std::vector<std::uint16_t> once_;
};

/// What resampled trials do to the statistic, and the variance of that.
Resampled resampled(const SharedNoise& shared, std::span<const std::uint16_t> counts) {
  if (shared.variance == 0.0) return {};
  const auto T = static_cast<double>(counts.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t t = 0; t < counts.size(); ++t) {
    const double times = counts[t] * shared.influences[t];
    sum += times;
    squares += times * shared.influences[t];
  }
  return {sum / T, std::max(0.0, squares - sum * sum / T) / (T * (T - 1.0))};
}

}  // namespace

void CrossedRows::add(const std::vector<std::vector<double>>& numbers) {
  assert(numbers.size() == trials_ + 1);
  values_.insert(values_.end(), numbers[0].begin(), numbers[0].end());
  for (std::size_t t = 0; t < trials_; ++t)
    without_.insert(without_.end(), numbers[t + 1].begin(), numbers[t + 1].end());
}

std::span<const std::uint16_t> Resampler::counts(std::size_t items, const std::string& kind) {
  auto& counts = drawn_[{kind, items}];
  if (!counts.empty()) return counts;
  counts.resize(resamples * items, 0);
  for (std::size_t b = 0; b < resamples; ++b) {
    const NormalStream stream(seed_, static_cast<std::uint32_t>(b), stream_ + "/" + kind);
    for (std::size_t i = 0; i < items; ++i)
      ++counts[b * items +
               static_cast<std::size_t>(stream.uniform(i) * static_cast<double>(items))];
  }
  return counts;
}

Estimate bootstrapped(const CrossedRows& crossed, const OfMeans& statistic, Resampler& resampler) {
  const std::size_t n = crossed.rows(), T = crossed.trials();
  if (n == 0) return {};
  if (n < least_rows) return {.value = statistic(means_of(crossed))};
  const Rows rows(crossed, statistic);
  const auto all = rows.all();
  if (!std::isfinite(all.value)) return {};
  const auto shared = shared_noise(crossed, rows.slopes());
  const double variance = all.variance + shared.variance;
  const double rounding = 1e-12 * all.value;
  if (variance <= rounding * rounding) return {all.value, all.value, all.value};

  const auto row_counts = resampler.counts(n, "rows"), trial_counts = resampler.counts(T, "trials");
  std::vector<double> studentised;
  for (std::size_t b = 0; b < Resampler::resamples; ++b) {
    const auto of_rows = rows.resampled(row_counts.subspan(b * n, n));
    const auto of_trials = resampled(shared, trial_counts.subspan(b * T, T));
    const double variance_there = of_rows.variance + of_trials.variance;
    const double t = (of_rows.value + of_trials.value - all.value) / std::sqrt(variance_there);
    constexpr double negligible =
        1e-6;  // of the variance: a resample of equal rows has only rounding
    if (std::isfinite(t) && variance_there > negligible * variance) studentised.push_back(t);
  }
  if (studentised.size() < Resampler::resamples - Resampler::resamples / 20)
    return {.value = all.value};
  std::sort(studentised.begin(), studentised.end());
  const double error = std::sqrt(variance);
  return {all.value, all.value - quantile(studentised, 0.975) * error,
          all.value - quantile(studentised, 0.025) * error};
}

}  // namespace gyrostat
