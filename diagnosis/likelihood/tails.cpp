#include <gyrostat/diagnosis/likelihood/tails.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/foretold.hpp>
#include <gyrostat/diagnosis/likelihood/noise_over.hpp>
#include <gyrostat/diagnosis/likelihood/outlier_mixture.hpp>
#include <gyrostat/diagnosis/likelihood/size_turns.hpp>

namespace gyrostat::gap {
namespace {

constexpr double looked_into = 10.0;  ///< log-likelihood of tails

/// Probability of so many events or more of a Poisson law.
double poisson_upper_tail(double events, double mean) {
  double below = 0.0, term = std::exp(-mean);
  for (double k = 0.0; k < events; k += 1.0, term *= mean / k) below += term;
  return std::max(0.0, 1.0 - below);
}

/// Flags those in blocks within which there are more wide ones than chance would have it.
std::vector<char> crowded(const std::vector<std::size_t>& samples, const std::vector<char>& wide,
                          double share) {
  constexpr double rare = 1e-4;
  std::vector<char> flags(samples.size(), 0);
  for (const std::size_t length : {samples_before, 8 * samples_before})
    for (std::size_t first = 0, last = 0; first < samples.size(); first = last) {
      double hits = 0.0;
      const std::size_t block = samples[first] / length;
      for (; last < samples.size() && samples[last] / length == block; ++last) hits += wide[last];
      const double mean = share * static_cast<double>(last - first);
      if (hits > 1.0 && poisson_upper_tail(hits, mean) < rare)
        std::fill(flags.begin() + static_cast<std::ptrdiff_t>(first),
                  flags.begin() + static_cast<std::ptrdiff_t>(last), char{1});
    }
  return flags;
}

/// Outliers come one by one: where wide values crowd, they are a burst, or what is left of a
/// motion, and do not count.
OutlierMixture of_the_scattered(const std::vector<std::size_t>& samples,
                                const std::vector<double>& squares, double narrow) {
  constexpr int most_rounds = 4;
  OutlierMixture mixture = outlier_mixture(squares, narrow);
  std::vector<char> left_out(squares.size(), 0);
  std::size_t kept = squares.size();
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<char> wide;
    for (const double s : squares) wide.push_back(mixture.is_wide(s));
    const auto crowds = crowded(samples, wide, mixture.share());
    std::vector<double> scattered;
    for (std::size_t k = 0; k < squares.size(); ++k) {
      left_out[k] |= crowds[k];
      if (left_out[k] == 0) scattered.push_back(squares[k]);
    }
    if (scattered.size() == kept || 2 * scattered.size() < squares.size()) break;
    kept = scattered.size();
    mixture = outlier_mixture(scattered, mixture.narrow);
  }
  return mixture;
}

OutlierMixture mixture_of(const Whitened& w) {
  const double deviation = robust_deviation(w.innovations);
  std::vector<double> squares;
  for (const double e : w.innovations) squares.push_back(e * e);
  return outlier_mixture(squares, deviation * deviation);
}

/// Log-likelihood of a sample.
double likelihood_of_one(const Whitened& w, const OutlierMixture& mixture) {
  const auto n = static_cast<double>(w.innovations.size());
  double total = 0.0;
  for (const double e : w.innovations) total += e * e;
  return mixture.gain / n - 0.5 * std::log(total / n);
}

/// Whether outliers are innovations, and what follows goes with them.
bool is_innovational(const Foretold& whole, const Foretold& beside) {
  const auto mixture = mixture_of(beside.errors);
  if (mixture.gain < looked_into) return false;
  const auto n = static_cast<double>(whole.errors.innovations.size());
  return n * (likelihood_of_one(whole.errors, mixture_of(whole.errors)) -
              likelihood_of_one(beside.errors, mixture)) >
         looked_into;
}

/// Of the noise with those that are too many to be left out: without them, means of what is left
/// would go farther than by chance with the level that it is left about.
double common_variance(const OutlierMixture& mixture) {
  constexpr double too_many = 0.05;
  double variance = mixture.narrow;
  for (const auto& w : mixture.wide)
    if (w.share > too_many) variance += w.share * (w.variance + w.size * w.size - mixture.narrow);
  return variance;
}

void tell_warmth(const Conditions& conditions, const Whitened& w, Tails& tails,
                 std::vector<double>& relative) {
  const auto& T = conditions.series().temperature_C;
  const auto n = static_cast<double>(w.innovations.size());
  std::vector<double> off;
  double mean = 0.0;
  for (const std::size_t i : w.samples) mean += T[i] / n;
  for (const std::size_t i : w.samples) off.push_back(T[i] - mean);
  const auto warm = noise_over(off, w.innovations, tails.deviation, far_off);
  tails.deviation = warm.deviation;
  tails.reference_C = mean;
  tails.noise_per_C = warm.slope;
  tails.noise_per_C2 = warm.curvature;
  tails.temperature_gain = std::max(0.0, warm.gain);
  // Of all samples, as the noise is fitted to all: those in bursts may be the warm ones.
  double squares = 0.0, count = 0.0;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i) {
      squares += std::pow(warm.gain_at(T[i] - mean), 2);
      count += 1.0;
    }
  tails.mean_square_of_warmth = squares / count;
  // What does not show does not scale the others.
  if (tails.temperature_gain >= 7.0)
    std::transform(off.begin(), off.end(), relative.begin(),
                   [&](double o) { return warm.gain_at(o); });
}

/// Samples whose error is of an outlier, and those that it moves by as much as the noise. Errors
/// that crowd are of none.
std::vector<char> flagged(const Conditions& conditions, const std::vector<double>& given,
                          const Foretold& f, double odd, double spread, bool innovational) {
  std::vector<std::size_t> samples;
  std::vector<double> errors;
  std::vector<char> wide;
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t i = span.first; i < span.last; ++i) {
        const double e = given[i] - prediction(f, i, span.first);
        if (is_missing(e)) continue;
        samples.push_back(i);
        errors.push_back(e);
        wide.push_back(std::abs(e) > odd * f.ahead[i]);
      }
  const auto all = static_cast<double>(std::count(wide.begin(), wide.end(), char{1}));
  const auto crowds = crowded(samples, wide, all / static_cast<double>(samples.size()));
  const auto response = innovational ? response_to_one(f.law) : std::vector<double>{1.0};
  std::vector<char> flags(given.size(), 0);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (wide[k] == 0 || crowds[k] != 0) continue;
    for (std::size_t j = 0; j < std::min(response.size(), given.size() - samples[k]); ++j)
      if (j == 0 || std::abs(errors[k] * response[j]) > spread) flags[samples[k] + j] = 1;
  }
  return flags;
}

}  // namespace

Tails tails_of(const Conditions& conditions, const std::vector<double>& given, bool temperature,
               Past past) {
  Tails tails;
  tails.outliers.assign(given.size(), 0);
  const auto present = present_in_train(conditions, given);
  if (present.size() < fewest_innovations) return tails;
  const double spread = robust_deviation(present);
  auto f = foretold_beside_outliers(conditions, given);
  if (f.errors.innovations.size() < fewest_innovations) return tails;
  if (past == Past::may_be_of_outliers) {
    auto whole = foretold(conditions, given);
    tails.innovational = is_innovational(whole, f);
    if (tails.innovational) f = std::move(whole);
  }
  const auto& w = f.errors;
  tails.deviation = robust_deviation(w.innovations);
  std::vector<double> relative(w.innovations.size(), 1.0);
  if (temperature) tell_warmth(conditions, w, tails, relative);

  std::vector<double> squares(w.innovations.size());
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const double e = w.innovations[k] / relative[k];
    squares[k] = e * e;
  }
  const double variance = tails.deviation * tails.deviation;
  // What follows one that is an innovation is foretold not quite, and is no crowd.
  const auto mixture = tails.innovational ? outlier_mixture(squares, variance)
                                          : of_the_scattered(w.samples, squares, variance);
  const double narrow = mixture.narrow;
  tails.deviation = std::sqrt(narrow);
  tails.outlier_gain = mixture.gain;
  if (mixture.gain > looked_into) tails.turns = turns_of(w.samples, squares, narrow);
  // Each hits by itself: the last, which are widest, those that the others hit, too.
  double missed = 1.0;
  for (auto wide = mixture.wide.rbegin(); wide != mixture.wide.rend(); ++wide) {
    tails.populations.push_back({.probability = wide->share / missed,
                                 .std_dps = std::sqrt(std::max(wide->variance - narrow, 0.0)),
                                 .mean_size_dps = wide->size});
    missed -= wide->share;
  }
  const double odd = 4.5 * std::sqrt(common_variance(mixture));
  double sum = 0.0, count = 0.0;
  for (const double s : squares)
    if (tails.innovational || s < odd * odd) sum += s, count += 1.0;
  tails.quiet = std::min(1.0, std::sqrt(narrow * count / sum));
  tails.outliers = flagged(conditions, given, f, odd, spread, tails.innovational);
  return tails;
}

}  // namespace gyrostat::gap
