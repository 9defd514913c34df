#include <gyrostat/diagnosis/likelihood/counted_samples.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <gyrostat/analysis/spectra/cosine_sums.hpp>

namespace gyrostat::gap {
namespace {

/// Whether pairs of samples that count, of which so many were looked at, are as likely far apart as
/// evenly hidden ones make them.
bool are_even(const std::vector<double>& pairs, double looked_at) {
  constexpr double clear = 6.0;  // standard deviations
  const double kept = pairs.front(), chance = kept * kept;
  const double apart = 0.5 * (kept - chance);
  const auto half = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  return *std::max_element(half, pairs.end()) > chance + apart &&
         apart > clear * std::sqrt(chance * (1.0 - chance) / looked_at);
}

}  // namespace

CountedSamples::CountedSamples(const Conditions& conditions, std::vector<char> masked,
                               std::size_t lags)
    : masked_(std::move(masked)),
      hides_any_(std::find(masked_.begin(), masked_.end(), char{1}) != masked_.end()) {
  double hidden = 0.0, all = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      hidden += masked_[i] != 0 ? 1.0 : 0.0;
      all += 1.0;
    }
  share_ = all > 0.0 ? 1.0 - hidden / all : 1.0;
  if (share_ == 1.0) return;
  count_pairs(conditions, lags);
  if (!come_evenly_) put_halfway(conditions);
}

void CountedSamples::count_pairs(const Conditions& conditions, std::size_t lags) {
  // Some of the pairs tell their shares well enough; where one of seven samples counts, or of
  // fourteen, it must not be that one.
  const double every = share_ < 0.2 ? 7.0 + 1.0 / std::numbers::phi : 7.0;
  pairs_.assign(lags, 0.0);
  std::vector<double> pairs_of_all(lags, 0.0);
  for (const auto& span : conditions.spans(Part::train))
    for (double at = 0.0; at < static_cast<double>(span.size()); at += every) {
      const std::size_t i = span.first + static_cast<std::size_t>(at);
      for (std::size_t lag = 0; lag < lags && i + lag < span.last; ++lag) {
        pairs_of_all[lag] += 1.0;
        pairs_[lag] += masked_[i] == 0 && masked_[i + lag] == 0 ? 1.0 : 0.0;
      }
    }
  for (std::size_t lag = 0; lag < lags; ++lag) pairs_[lag] /= std::max(pairs_of_all[lag], 1.0);
  come_evenly_ = are_even(pairs_, pairs_of_all.back());
}

void CountedSamples::put_halfway(const Conditions& conditions) {
  halfway_.assign(masked_.size(), 0);
  const std::size_t lags = pairs_.size();
  beside_halfway_.assign(lags, 0.0);
  both_halfway_.assign(lags, 0.0);
  std::vector<double> pairs_of_all(lags, 0.0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part)) {
      for (std::size_t i = span.first + 1; i + 1 < span.last; ++i)
        halfway_[i] = masked_[i] != 0 && masked_[i - 1] == 0 && masked_[i + 1] == 0 ? 1 : 0;
      if (part != Part::train) continue;
      for (std::size_t lag = 0; lag < std::min(lags, span.size()); ++lag)
        pairs_of_all[lag] += static_cast<double>(span.size() - lag);
      for (std::size_t i = span.first; i < span.last; ++i) {
        if (halfway_[i] == 0) continue;
        for (std::size_t lag = 0; lag < lags && i + lag < span.last; ++lag) {
          both_halfway_[lag] += halfway_[i + lag] != 0 ? 1.0 : 0.0;
          beside_halfway_[lag] += masked_[i + lag] == 0 ? 0.5 : 0.0;
        }
        for (std::size_t lag = 0; lag < lags && i >= span.first + lag; ++lag)
          beside_halfway_[lag] += masked_[i - lag] == 0 ? 0.5 : 0.0;
      }
    }
  for (auto* shares : {&beside_halfway_, &both_halfway_})
    for (std::size_t lag = 0; lag < lags; ++lag) (*shares)[lag] /= std::max(pairs_of_all[lag], 1.0);
}

std::vector<double> CountedSamples::density(std::vector<double> of_all) const {
  // The covariance of a product of independent series is the product of their covariances.
  const auto covariance = cosine_sums(of_all);
  const auto last = static_cast<std::ptrdiff_t>(covariance.size()) - 1;
  const auto at = [&](std::ptrdiff_t lag) {
    return covariance[static_cast<std::size_t>(last - std::abs(last - std::abs(lag)))];
  };
  std::vector<double> shown(covariance.size());
  for (std::ptrdiff_t lag = 0; lag <= last; ++lag) {
    const auto k = static_cast<std::size_t>(lag);
    shown[k] = pairs_[k] * at(lag);
    if (!halfway_.empty())
      shown[k] += beside_halfway_[k] * (at(lag - 1) + at(lag + 1)) +
                  0.25 * both_halfway_[k] * (at(lag - 2) + 2.0 * at(lag) + at(lag + 2));
    shown[k] /= (2.0 * static_cast<double>(last));
  }
  return cosine_sums(shown);
}

}  // namespace gyrostat::gap
