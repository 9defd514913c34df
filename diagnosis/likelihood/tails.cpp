#include <gyrostat/diagnosis/likelihood/tails.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/autoregression.hpp>
#include <gyrostat/diagnosis/likelihood/noise_over.hpp>
#include <gyrostat/diagnosis/likelihood/outlier_mixture.hpp>
#include <gyrostat/diagnosis/likelihood/size_turns.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t order = 16;
constexpr std::size_t fewest_innovations = 500;
constexpr double looked_into = 10.0;  ///< log-likelihood of tails
constexpr double cut = 4.0;  ///< standard deviations beyond which a sample does not count at first

double robust_deviation(std::vector<double> values) {
  for (double& v : values) v = std::abs(v);
  return quantile(std::move(values), 0.5) / normal_quartile;
}

struct Whitened {
  std::vector<std::size_t> samples;
  std::vector<double> innovations;
};

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

std::vector<double> present_in_train(const Conditions& conditions,
                                     const std::vector<double>& given) {
  std::vector<double> present;
  for (const auto& span : conditions.spans(Part::train))
    for (std::size_t i = span.first; i < span.last; ++i)
      if (!is_missing(given[i])) present.push_back(given[i]);
  return present;
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
  for (const std::size_t length : {order, 8 * order})
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

/// Samples by those before them.
struct Foretold {
  Autoregression law;
  std::vector<double> history;  ///< that they are foretold by
  std::vector<double> ahead;    ///< deviation of a sample's error, of that of one step ahead
  Whitened errors;              ///< of the train part, each as of one step ahead
};

Foretold foretold(const Conditions& conditions, const std::vector<double>& given,
                  std::vector<double> history, std::vector<double> ahead) {
  Foretold f{
      autoregression(covariances(conditions, history)), std::move(history), std::move(ahead), {}};
  // Where few have all before them, those that foretell them; and where few have these, none.
  for (const std::size_t needed : {order, foretelling(f.law), std::size_t{0}}) {
    f.errors = whiten(conditions, f.history, Part::train, f.law.coefficients, needed);
    if (2 * f.errors.samples.size() >= present_in_train(conditions, given).size()) break;
  }
  for (std::size_t k = 0; k < f.errors.samples.size(); ++k) {
    const std::size_t i = f.errors.samples[k];
    f.errors.innovations[k] += given[i] - f.history[i];
    f.errors.innovations[k] /= f.ahead[i];
  }
  return f;
}

/// From those before `i` in `history`; what is missing is as if it were zero.
double prediction(const std::vector<double>& history, const std::vector<double>& coefficients,
                  std::size_t i, std::size_t first) {
  double sum = 0.0;
  for (std::size_t j = 0; j < std::min(order, i - first); ++j)
    if (const double before = history[i - 1 - j]; !is_missing(before))
      sum -= coefficients[j] * before;
  return sum;
}

/// Response of the autoregression to one innovation, until little is left of it.
std::vector<double> response_to_one(const std::vector<double>& coefficients) {
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

/// What is far from its prediction is replaced by it (Martin and Thomson, Proc. IEEE 70, 1982), so
/// that an outlier is one innovation and not seventeen. From samples replaced in a row the next is
/// foretold as many steps ahead.
Foretold cleaned(const Conditions& conditions, const std::vector<double>& given,
                 const Foretold& by) {
  const double limit = cut * robust_deviation(by.errors.innovations);
  std::vector<double> deviations;  // so many steps ahead
  double sum = 0.0;
  for (const double r : response_to_one(by.law.coefficients))
    deviations.push_back(std::sqrt(sum += r * r));
  auto history = given;
  std::vector<double> ahead(given.size(), 1.0);
  for (const Part part : both_parts)
    for (const auto& span : conditions.spans(part))
      for (std::size_t i = span.first, replaced = 0; i < span.last; ++i) {
        if (is_missing(given[i])) continue;
        ahead[i] = deviations[std::min(replaced, deviations.size() - 1)];
        const double expected = prediction(history, by.law.coefficients, i, span.first);
        const bool is_far = std::abs(given[i] - expected) > limit * ahead[i];
        if (is_far) history[i] = expected;
        replaced = is_far ? replaced + 1 : 0;
      }
  return foretold(conditions, given, std::move(history), std::move(ahead));
}

Foretold beside_outliers(const Conditions& conditions, const std::vector<double>& given,
                         double spread) {
  const double limit = 5.0 * spread;
  auto history = given;
  for (double& v : history)
    if (!is_missing(v)) v = std::clamp(v, -limit, limit);
  const std::vector<double> one_step(given.size(), 1.0);
  auto f = foretold(conditions, given, std::move(history), one_step);
  constexpr int passes = 3;
  for (int pass = 0; pass < passes && f.errors.samples.size() >= fewest_innovations; ++pass)
    f = cleaned(conditions, given, f);
  return f;
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
  const auto warm = noise_over(off, w.innovations, tails.deviation, cut);
  tails.deviation = warm.deviation;
  tails.reference_C = mean;
  tails.noise_per_C = warm.slope;
  tails.noise_per_C2 = warm.curvature;
  tails.temperature_gain = std::max(0.0, warm.gain);
  tails.mean_square_of_warmth = 0.0;
  for (const double o : off) tails.mean_square_of_warmth += std::pow(warm.gain_at(o), 2) / n;
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
        const double e = given[i] - prediction(f.history, f.law.coefficients, i, span.first);
        if (is_missing(e)) continue;
        samples.push_back(i);
        errors.push_back(e);
        wide.push_back(std::abs(e) > odd * f.ahead[i]);
      }
  const auto all = static_cast<double>(std::count(wide.begin(), wide.end(), char{1}));
  const auto crowds = crowded(samples, wide, all / static_cast<double>(samples.size()));
  const auto response =
      innovational ? response_to_one(f.law.coefficients) : std::vector<double>{1.0};
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
  auto f = beside_outliers(conditions, given, spread);
  if (f.errors.innovations.size() < fewest_innovations) return tails;
  if (past == Past::may_be_of_outliers) {
    auto whole = foretold(conditions, given, given, std::vector<double>(given.size(), 1.0));
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

std::vector<char> samples_beside_jumps(const std::vector<double>& left_dps,
                                       const std::vector<Span>& blocks) {
  std::vector<char> flags(left_dps.size(), 0);
  std::vector<double> present;
  for (const double v : left_dps)
    if (!is_missing(v)) present.push_back(v);
  if (present.empty()) return flags;
  // Cut, so that no single sample makes two levels.
  const double deviation = robust_deviation(std::move(present)), most = 3.0 * deviation;
  constexpr double clear = 25.0,
                   fewest = 4.0;  // of squares, in variances; of samples, on each side
  for (const auto& [first, last] : blocks) {
    double total = 0.0, all = 0.0;
    const auto value = [&](std::size_t i) { return std::clamp(left_dps[i], -most, most); };
    for (std::size_t i = first; i < last; ++i)
      if (!is_missing(left_dps[i])) total += value(i), all += 1.0;
    double sum = 0.0, count = 0.0, explained = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      if (is_missing(left_dps[i])) continue;
      sum += value(i);
      count += 1.0;
      if (count < fewest || all - count < fewest) continue;
      const double rest = all - count;
      const double apart = sum / count - (total - sum) / rest;
      explained = std::max(explained, apart * apart * count * rest / all);
    }
    if (explained > clear * deviation * deviation)
      std::fill(flags.begin() + static_cast<std::ptrdiff_t>(first),
                flags.begin() + static_cast<std::ptrdiff_t>(last), char{1});
  }
  return flags;
}

}  // namespace gyrostat::gap
