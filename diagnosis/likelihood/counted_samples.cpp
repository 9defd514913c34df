#include <gyrostat/diagnosis/likelihood/counted_samples.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include <gyrostat/analysis/spectra/cosine_sums.hpp>

namespace gyrostat::gap {
namespace {

/// A bit a sample, span by span. Shares of pairs are counted all: what a steep density has least of
/// is what is left where they cancel.
class Flags {
 public:
  template <class IsSet>
  Flags(const std::vector<Span>& spans, const IsSet& is_set) {
    for (const auto& span : spans) {
      auto& words = spans_.emplace_back(span.size() / bits + 1, 0);
      for (std::size_t i = 0; i < span.size(); ++i)
        if (is_set(span.first + i)) words[i / bits] |= std::uint64_t{1} << (i % bits);
    }
  }

  /// How many are so many samples before one of the others.
  double pairs_with(const Flags& others, std::size_t lag) const {
    const std::size_t whole = lag / bits, rest = lag % bits;
    std::int64_t count = 0;
    for (std::size_t s = 0; s < spans_.size(); ++s) {
      const auto& later = others.spans_[s];
      for (std::size_t k = 0; k + whole < later.size(); ++k) {
        std::uint64_t word = later[k + whole] >> rest;
        if (rest != 0 && k + whole + 1 < later.size())
          word |= later[k + whole + 1] << (bits - rest);
        count += std::popcount(spans_[s][k] & word);
      }
    }
    return static_cast<double>(count);
  }

 private:
  static constexpr std::size_t bits = 64;
  std::vector<std::vector<std::uint64_t>> spans_;
};

std::vector<double> pairs_of_all(const std::vector<Span>& spans, std::size_t lags) {
  std::vector<double> pairs(lags, 0.0);
  for (const auto& span : spans)
    for (std::size_t lag = 0; lag < std::min(lags, span.size()); ++lag)
      pairs[lag] += static_cast<double>(span.size() - lag);
  return pairs;
}

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
  const auto& train = conditions.spans(Part::train);
  const Flags counted(train, [&](std::size_t i) { return masked_[i] == 0; });
  const auto all = pairs_of_all(train, lags);
  pairs_.resize(lags);
  for (std::size_t lag = 0; lag < lags; ++lag)
    pairs_[lag] = counted.pairs_with(counted, lag) / std::max(all[lag], 1.0);
  come_evenly_ = are_even(pairs_, all.back());
}

void CountedSamples::put_halfway(const Conditions& conditions) {
  halfway_.assign(masked_.size(), 0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t i = span.first + 1; i + 1 < span.last; ++i)
        halfway_[i] = masked_[i] != 0 && masked_[i - 1] == 0 && masked_[i + 1] == 0 ? 1 : 0;
  const auto& train = conditions.spans(Part::train);
  const Flags counted(train, [&](std::size_t i) { return masked_[i] == 0; });
  const Flags halfway(train, [&](std::size_t i) { return halfway_[i] != 0; });
  const std::size_t lags = pairs_.size();
  const auto all = pairs_of_all(train, lags);
  beside_halfway_.resize(lags);
  both_halfway_.resize(lags);
  for (std::size_t lag = 0; lag < lags; ++lag) {
    const double pairs = std::max(all[lag], 1.0);
    beside_halfway_[lag] =
        0.5 * (counted.pairs_with(halfway, lag) + halfway.pairs_with(counted, lag)) / pairs;
    both_halfway_[lag] = halfway.pairs_with(halfway, lag) / pairs;
  }
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
