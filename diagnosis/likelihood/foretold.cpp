#include <gyrostat/diagnosis/likelihood/foretold.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t order = samples_before;

/// Of samples of which so many before are there; those further back that are missing are as if they
/// were zero.
Whitened whiten(const Conditions& conditions, const std::vector<double>& left, Part part,
                const std::vector<double>& coefficients, std::size_t present) {
  Whitened w;
  for (const auto& span : conditions.spans(part))
    for (std::size_t i = span.first + order; i < span.last; ++i) {
      double e = left[i];
      for (std::size_t j = 0; j < order; ++j)
        if (const double before = left[i - 1 - j]; j < present || !is_missing(before))
          e += coefficients[j] * before;
      if (is_missing(e)) continue;
      w.samples.push_back(i);
      w.innovations.push_back(e);
    }
  return w;
}

/// How many samples before one foretell it: what all others add is little beside its error.
std::size_t foretelling(const Autoregression& law) {
  constexpr double little = 0.02;
  const auto& a = law.coefficients;
  double others = 0.0;
  std::size_t count = a.size();
  while (count > 0) {
    others += a[count - 1] * a[count - 1] * law.errors.front();
    if (others > little * law.errors.back()) break;
    --count;
  }
  return count;
}

std::vector<double> covariances(const Conditions& conditions, const std::vector<double>& left) {
  std::vector<double> sums(order + 1, 0.0), counts(order + 1, 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      if (is_missing(left[i])) continue;
      for (std::size_t lag = 0; lag <= order && i >= span.first + lag; ++lag)
        if (!is_missing(left[i - lag])) {
          sums[lag] += left[i] * left[i - lag];
          counts[lag] += 1.0;
        }
    }
  // Of samples that are missing evenly, hardly any are at some lags.
  constexpr double fewest = 100.0;
  for (std::size_t lag = 0; lag <= order; ++lag)
    sums[lag] = counts[lag] < fewest
                    ? 0.0
                    : sums[lag] / (counts[lag] * (1.0 + 1e-3 * (lag > 0 ? 1.0 : 0.0)));
  return sums;
}

Foretold foretold(const Conditions& conditions, const std::vector<double>& given,
                  std::vector<double> history, std::vector<double> ahead) {
  Foretold f{
      autoregression(covariances(conditions, history)), std::move(history), std::move(ahead), {}};
  const std::size_t present = present_in_train(conditions, given).size();
  // Where few have all before them, those that foretell them; and where few have these, none.
  for (const std::size_t needed : {order, foretelling(f.law), std::size_t{0}}) {
    f.errors = whiten(conditions, f.history, Part::train, f.law.coefficients, needed);
    if (2 * f.errors.samples.size() >= present) break;
  }
  for (std::size_t k = 0; k < f.errors.samples.size(); ++k) {
    const std::size_t i = f.errors.samples[k];
    f.errors.innovations[k] += given[i] - f.history[i];
    f.errors.innovations[k] /= f.ahead[i];
  }
  return f;
}

double predicted(const std::vector<double>& history, const std::vector<double>& coefficients,
                 std::size_t i, std::size_t first) {
  double sum = 0.0;
  for (std::size_t j = 0; j < std::min(order, i - first); ++j)
    if (const double before = history[i - 1 - j]; !is_missing(before))
      sum -= coefficients[j] * before;
  return sum;
}

Foretold cleaned(const Conditions& conditions, const std::vector<double>& given,
                 const Foretold& by) {
  const double limit = far_off * robust_deviation(by.errors.innovations);
  std::vector<double> deviations;  // so many steps ahead
  double sum = 0.0;
  for (const double r : response_to_one(by.law)) deviations.push_back(std::sqrt(sum += r * r));
  auto history = given;
  std::vector<double> ahead(given.size(), 1.0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t i = span.first, replaced = 0; i < span.last; ++i) {
        if (is_missing(given[i])) continue;
        ahead[i] = deviations[std::min(replaced, deviations.size() - 1)];
        const double expected = predicted(history, by.law.coefficients, i, span.first);
        const bool is_far = std::abs(given[i] - expected) > limit * ahead[i];
        if (is_far) history[i] = expected;
        replaced = is_far ? replaced + 1 : 0;
      }
  return foretold(conditions, given, std::move(history), std::move(ahead));
}

}  // namespace

Foretold foretold(const Conditions& conditions, const std::vector<double>& given_dps) {
  return foretold(conditions, given_dps, given_dps, std::vector<double>(given_dps.size(), 1.0));
}

Foretold foretold_beside_outliers(const Conditions& conditions,
                                  const std::vector<double>& given_dps) {
  const double limit = 5.0 * robust_deviation(present_in_train(conditions, given_dps));
  auto history = given_dps;
  for (double& v : history)
    if (!is_missing(v)) v = std::clamp(v, -limit, limit);
  const std::vector<double> one_step(given_dps.size(), 1.0);
  auto f = foretold(conditions, given_dps, std::move(history), one_step);
  constexpr int passes = 3;
  for (int pass = 0; pass < passes && f.errors.samples.size() >= fewest_innovations; ++pass)
    f = cleaned(conditions, given_dps, f);
  return f;
}

double prediction(const Foretold& by, std::size_t sample, std::size_t first) {
  return predicted(by.history, by.law.coefficients, sample, first);
}

std::vector<double> response_to_one(const Autoregression& law) {
  const auto& coefficients = law.coefficients;
  constexpr double little = 0.01;
  constexpr std::size_t most = 1000;
  std::vector<double> response{1.0};
  for (std::size_t k = 1, small = 0; k < most && small < order; ++k) {
    double value = 0.0;
    for (std::size_t j = 0; j < std::min(order, k); ++j)
      value -= coefficients[j] * response[k - 1 - j];
    response.push_back(value);
    small = std::abs(value) < little ? small + 1 : 0;
  }
  return response;
}

std::vector<double> present_in_train(const Conditions& conditions,
                                     const std::vector<double>& values) {
  std::vector<double> present;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(values[i])) present.push_back(values[i]);
  return present;
}

double robust_deviation(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  return quantile(std::move(values), 0.5) / normal_quartile;
}

}  // namespace gyrostat::gap
