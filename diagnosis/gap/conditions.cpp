#include <gyrostat/diagnosis/gap/conditions.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/gap/between_steps.hpp>
#include <gyrostat/diagnosis/gap/local_trend.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t slow_points = 3000, fewest_slow_points = 1000;
constexpr double slow_s = 0.4;
constexpr std::size_t shortest_cluster = 4;
constexpr std::size_t shortest_span = 64;
constexpr std::size_t shortest_slow_span = 2;
constexpr double warming_interval_s = 10.0;
constexpr double least_step_C = 1e-6;

/// Maximal runs of present indices of one part.
template <class Present, class PartOf>
std::array<std::vector<Span>, 2> runs(std::size_t size, std::size_t shortest,
                                      const Present& present, const PartOf& part_of) {
  std::array<std::vector<Span>, 2> spans;
  std::size_t first = 0;
  while (first < size) {
    if (!present(first)) {
      ++first;
      continue;
    }
    const Part part = part_of(first);
    std::size_t last = first + 1;
    while (last < size && present(last) && part_of(last) == part) ++last;
    if (last - first >= shortest) spans[static_cast<int>(part)].push_back({first, last});
    first = last;
  }
  return spans;
}

/// Straight lines over NaN, the nearest value before the first and after the last.
void interpolate_missing(std::vector<double>& values) {
  std::size_t last = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_missing(values[i])) continue;
    const std::size_t first = last == values.size() ? 0 : last + 1;
    const double from = last == values.size() ? values[i] : values[last];
    for (std::size_t k = first; k < i; ++k)
      values[k] = from + (values[i] - from) * static_cast<double>(k - first + 1) /
                             static_cast<double>(i - first + 1);
    last = i;
  }
  if (last < values.size())
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(last), values.end(), values[last]);
}

}  // namespace

Conditions::Conditions(const Series& recording, Split split) : series_(recording) {
  for (auto* channel : {&series_.temperature_C, &series_.rate_ref_dps, &series_.acc_x_mps2,
                        &series_.acc_y_mps2, &series_.acc_z_mps2})
    interpolate_missing(*channel);
  series_.temperature_C = between_steps(std::move(series_.temperature_C), least_step_C);
  const std::size_t n = series_.size();
  interval_s_ = n > 1 ? series_.duration_s() / static_cast<double>(n - 1) : 1.0;
  const auto slow_samples = static_cast<std::size_t>(std::lround(slow_s / interval_s_));
  cluster_ =
      std::max({shortest_cluster, n / slow_points, std::min(slow_samples, n / fewest_slow_points)});
  parts_.assign(std::max<std::size_t>(1, n / cluster_), Part::train);
  if (split != Split::none)
    for (std::size_t k = 0; k < parts_.size(); ++k)
      if (k * blocks / parts_.size() % 4 == (split == Split::in_parts ? 2 : 1))
        parts_[k] = Part::held_out;
  find_spans();

  slow_time_s_ = slow_means(series_.t_s);
  if (has_temperature()) {
    slow_temperature_C_ = slow_means(series_.temperature_C);
    const auto lag = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(warming_interval_s / slow_interval_s())));
    slow_warming_.resize(slow_size());
    for (std::size_t i = 0; i < slow_size(); ++i) {
      const std::size_t from = i < lag ? 0 : i - lag;
      slow_warming_[i] = i == 0 ? 0.0
                                : (slow_temperature_C_[i] - slow_temperature_C_[from]) /
                                      (slow_time_s_[i] - slow_time_s_[from]);
    }
  }
  if (!series_.rate_ref_dps.empty()) {
    const auto& rate = series_.rate_ref_dps;
    const auto [low, high] = std::minmax_element(rate.begin(), rate.end());
    turned_deg_.assign(n, 0.0);
    for (std::size_t i = 1; i < n; ++i) turned_deg_[i] = turned_deg_[i - 1] + rate[i] * interval_s_;
    if (*high - *low > 1e-3) {
      motion_dps_s_.assign(n, 0.0);
      for (std::size_t i = 1; i + 1 < n; ++i)
        motion_dps_s_[i] = (rate[i + 1] - rate[i - 1]) / (2.0 * interval_s_);
    }
  }
  find_drift();
}

Part Conditions::part_of(std::size_t sample) const {
  return parts_[std::min(sample / cluster_, parts_.size() - 1)];
}

void Conditions::find_spans() {
  const auto& z = series_.gyro_dps;
  std::vector<char> present(size(), 1);
  for (std::size_t i = 0; i < size();) {
    if (!is_missing(z[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < size() && is_missing(z[end])) ++end;
    if (i > 0 && end < size() && end - i <= bridged && part_of(i - 1) == part_of(end))
      gaps_.push_back({i, end});
    else
      std::fill(present.begin() + static_cast<std::ptrdiff_t>(i),
                present.begin() + static_cast<std::ptrdiff_t>(end), char{0});
    i = end;
  }
  fast_ = runs(
      size(), shortest_span, [&](std::size_t i) { return present[i] != 0; },
      [&](std::size_t i) { return part_of(i); });
  std::vector<char> whole(size() / cluster_, 1);
  for (std::size_t i = 0; i < whole.size() * cluster_; ++i)
    if (present[i] == 0) whole[i / cluster_] = 0;
  slow_ = runs(
      whole.size(), shortest_slow_span, [&](std::size_t i) { return whole[i] != 0; },
      [&](std::size_t i) { return part_of(i * cluster_); });
}

void Conditions::find_drift() {
  constexpr double least_C = 0.02;
  const bool regress =
      has_temperature() &&
      *std::max_element(slow_temperature_C_.begin(), slow_temperature_C_.end()) -
              *std::min_element(slow_temperature_C_.begin(), slow_temperature_C_.end()) >
          least_C;
  drift_regressors_ =
      Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(slow_size()), regress ? 4 : 1);
  const auto slopes =
      regress ? slopes_in_noise(slow_time_s_, slow_temperature_C_) : std::vector<double>{};
  for (std::size_t i = 0; regress && i < slow_size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    drift_regressors_(row, 1) = slow_temperature_C_[i] - slow_temperature_C_[0];
    drift_regressors_(row, 2) = slow_warming_[i];
    drift_regressors_(row, 3) = slopes[i];
  }
  for (const auto& span : slow_spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) train_points_.push_back(i);

  std::vector<double> rate_error = series_.gyro_dps;
  for (std::size_t i = 0; i < series_.rate_ref_dps.size(); ++i)
    rate_error[i] -= series_.rate_ref_dps[i];
  bridge(rate_error);
  const RatioLikelihood likelihood(train_points_, train_regressors(),
                                   train_values(slow_means(rate_error)));
  level_.emplace(train_points_, likelihood.most_likely());
  const Eigen::MatrixXd white = level_->innovations_of_columns(train_regressors());
  drift_fit_ = white.transpose();
  if (!regress) return;
  const Eigen::MatrixXd normal = white.transpose() * white;
  drift_fit_ = pseudo_inverse(normal) * white.transpose();
}

Eigen::VectorXd Conditions::train_values(const std::vector<double>& slow) const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(train_points_.size()));
  for (std::size_t k = 0; k < train_points_.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = slow[train_points_[k]];
  return values;
}

Eigen::MatrixXd Conditions::train_regressors() const {
  const Eigen::Index columns = drift_regressors_.cols() - 1;
  Eigen::MatrixXd chosen(static_cast<Eigen::Index>(train_points_.size()), columns);
  if (columns == 0) return chosen;
  for (std::size_t k = 0; k < train_points_.size(); ++k)
    chosen.row(static_cast<Eigen::Index>(k)) =
        drift_regressors_.row(static_cast<Eigen::Index>(train_points_[k])).tail(columns);
  return chosen;
}

Eigen::VectorXd Conditions::drift_of(const std::vector<double>& slow) const {
  const Eigen::VectorXd values = train_values(slow);
  Eigen::VectorXd coefficients(drift_regressors_.cols());
  coefficients.tail(drift_fit_.rows()) = drift_fit_ * level_->innovations(values);
  coefficients[0] = (values - train_regressors() * coefficients.tail(drift_fit_.rows())).mean();
  return coefficients;
}

std::vector<double> Conditions::drift(const Eigen::VectorXd& coefficients) const {
  const Eigen::VectorXd values = drift_regressors_ * coefficients;
  return {values.begin(), values.end()};
}

void Conditions::bridge(std::vector<double>& values) const {
  for (const auto& gap : gaps_) {
    const double before = values[gap.first - 1];
    const double step = (values[gap.last] - before) / static_cast<double>(gap.size() + 1);
    for (std::size_t i = gap.first; i < gap.last; ++i)
      values[i] = before + step * static_cast<double>(i - gap.first + 1);
  }
}

std::vector<double> Conditions::slow_means(const std::vector<double>& values) const {
  std::vector<double> means(size() / cluster_);
  for (std::size_t k = 0; k < means.size(); ++k) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = k * cluster_; i < (k + 1) * cluster_; ++i)
      if (!is_missing(values[i])) {
        sum += values[i];
        ++count;
      }
    means[k] = count > 0 ? sum / static_cast<double>(count) : no_value;
  }
  return means;
}

}  // namespace gyrostat::gap
