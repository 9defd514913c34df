#include <gyrostat/diagnosis/likelihood/felt_acceleration.hpp>

#include <algorithm>
#include <cmath>

#include <gyrostat/core/numerics/dense.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

constexpr double least_deviation = 0.5;

/// Straight between the middles of clusters, a value a sample.
std::vector<double> between_means(const Conditions& conditions, const std::vector<double>& means) {
  const auto cluster = static_cast<double>(conditions.cluster());
  std::vector<double> values(conditions.size(), no_value);
  for (std::size_t i = 0; i < values.size() && !means.empty(); ++i) {
    const double at = std::clamp((static_cast<double>(i) + 0.5) / cluster - 0.5, 0.0,
                                 static_cast<double>(means.size() - 1));
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, means.size() - 1);
    values[i] = means[low] + (at - static_cast<double>(low)) * (means[high] - means[low]);
  }
  return values;
}

/// Less its means of clusters.
std::vector<double> within_clusters(const Conditions& conditions, std::vector<double> values) {
  const auto slow = between_means(conditions, conditions.slow_means(values));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= slow[i];
  return values;
}

}  // namespace

bool is_shaken(const Conditions& conditions) {
  for (const auto channel : {&Series::acc_x_mps2, &Series::acc_y_mps2, &Series::acc_z_mps2}) {
    const auto& values = conditions.series().*channel;
    if (values.empty()) continue;
    const auto fast = within_clusters(conditions, values);
    double squares = 0.0, count = 0.0;
    for (const auto& span : conditions.spans(Part::train))
      for (std::size_t i = span.first; i < span.last; ++i)
        if (!is_missing(fast[i])) squares += fast[i] * fast[i], count += 1.0;
    if (squares > least_deviation * least_deviation * count) return true;
  }
  return false;
}

std::optional<SizesWithin> sizes_within_clusters(const Conditions& conditions,
                                                 const std::vector<char>& masked,
                                                 const std::vector<double>& error,
                                                 const std::vector<std::vector<double>>& courses) {
  const auto n = static_cast<Eigen::Index>(courses.size());
  std::vector<std::vector<double>> fast;
  for (const auto& course : courses) fast.push_back(within_clusters(conditions, course));
  auto counted = error;
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (masked[i] != 0) counted[i] = no_value;
  const auto left = within_clusters(conditions, counted);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n), row(n);
  double squares = 0.0, count = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      for (Eigen::Index c = 0; c < n; ++c) row[c] = fast[static_cast<std::size_t>(c)][i];
      if (is_missing(left[i]) || is_missing(row.sum())) continue;
      normal += row * row.transpose();
      right += left[i] * row;
      squares += left[i] * left[i];
      count += 1.0;
    }
  if (!(normal.diagonal().minCoeff() > least_deviation * least_deviation * count)) return {};
  const auto [inverse, pivots, positive] = invert_symmetric(normal);
  if (!positive) return {};
  const Eigen::VectorXd sizes = inverse * right;
  const double variance = std::max(0.0, squares - right.dot(sizes)) / count;
  SizesWithin found;
  for (Eigen::Index c = 0; c < n; ++c) {
    found.sizes.push_back(sizes[c]);
    found.errors.push_back(std::sqrt(variance * inverse(c, c)));
  }
  return found;
}

void keep_what_shows(const Conditions& conditions, const std::vector<char>& masked,
                     const std::vector<double>& error, std::vector<double>& felt) {
  auto counted = felt, shown = error;
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (masked[i] != 0 || is_missing(error[i]) || is_missing(felt[i]))
      counted[i] = shown[i] = no_value;
  const auto slow = between_means(conditions, conditions.slow_means(counted));
  const auto slow_error = between_means(conditions, conditions.slow_means(shown));
  double squares = 0.0, products = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      const double fast = counted[i] - slow[i], of_error = shown[i] - slow_error[i];
      if (is_missing(fast) || is_missing(of_error)) continue;
      squares += fast * fast;
      products += fast * of_error;
    }
  const double share = squares > 0.0 ? std::clamp(products / squares, 0.0, 1.0) : 1.0;
  for (std::size_t i = 0; i < felt.size(); ++i)
    if (!is_missing(slow[i])) felt[i] = slow[i] + share * (felt[i] - slow[i]);
}

}  // namespace gyrostat::gap
