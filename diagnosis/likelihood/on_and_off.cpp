#include <gyrostat/diagnosis/likelihood/on_and_off.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <gyrostat/core/step.hpp>

namespace gyrostat::gap {
namespace {

using OffAndOn = std::array<double, 2>;

/// How often a stretch is expected to be on, and to go from one to the other.
struct Expected {
  double on = 0.0, value_on = 0.0, off = 0.0, value_off = 0.0;
  double before_off = 0.0, begun = 0.0, before_on = 0.0, ended = 0.0;
};

/// Of a value, relative to the likelier of both.
OffAndOn likelihood(const OnAndOff& chain, double log_of_means, double value) {
  if (is_missing(value)) return {1.0, 1.0};
  const double for_on = chain.weight * (value * (1.0 / chain.off - 1.0 / chain.on) - log_of_means);
  const double other = std::exp(-std::abs(for_on));
  return for_on > 0.0 ? OffAndOn{other, 1.0} : OffAndOn{1.0, other};
}

OffAndOn normalised(OffAndOn x) {
  const double sum = x[0] + x[1];
  return {x[0] / sum, x[1] / sum};
}

/// Forward and backward once; adds to `expected`.
std::vector<double> smoothed(const OnAndOff& chain, const std::vector<double>& values,
                             Expected& expected) {
  const std::size_t n = values.size();
  std::vector<OffAndOn> seen(n), ahead(n);
  OffAndOn foretold = normalised({chain.ends, chain.begins});
  const double log_of_means = std::log(chain.on / chain.off);
  for (std::size_t k = 0; k < n; ++k) {
    seen[k] = likelihood(chain, log_of_means, values[k]);
    ahead[k] = normalised({foretold[0] * seen[k][0], foretold[1] * seen[k][1]});
    foretold = {ahead[k][0] * (1.0 - chain.begins) + ahead[k][1] * chain.ends,
                ahead[k][0] * chain.begins + ahead[k][1] * (1.0 - chain.ends)};
  }
  std::vector<double> chances(n);
  OffAndOn behind = {1.0, 1.0};
  for (std::size_t k = n; k-- > 0;) {
    const double on = normalised({ahead[k][0] * behind[0], ahead[k][1] * behind[1]})[1];
    chances[k] = on;
    if (!is_missing(values[k])) {
      expected.on += on;
      expected.value_on += on * values[k];
      expected.off += 1.0 - on;
      expected.value_off += (1.0 - on) * values[k];
    }
    if (k == 0) break;
    const OffAndOn here = {seen[k][0] * behind[0], seen[k][1] * behind[1]};
    const double from_off = ahead[k - 1][0], from_on = ahead[k - 1][1];
    const double begun = from_off * chain.begins * here[1];
    const double ended = from_on * chain.ends * here[0];
    const double stays_off = from_off * (1.0 - chain.begins) * here[0];
    const double stays_on = from_on * (1.0 - chain.ends) * here[1];
    const double sum = begun + ended + stays_off + stays_on;
    expected.begun += begun / sum;
    expected.ended += ended / sum;
    expected.before_off += (begun + stays_off) / sum;
    expected.before_on += (ended + stays_on) / sum;
    behind = normalised({(1.0 - chain.begins) * here[0] + chain.begins * here[1],
                         chain.ends * here[0] + (1.0 - chain.ends) * here[1]});
  }
  return chances;
}

}  // namespace

std::vector<double> OnAndOff::chance_of_on(const std::vector<double>& values) const {
  Expected unused;
  return smoothed(*this, values, unused);
}

OnAndOff OnAndOff::in_any_order(const TwoExponentials& means, double weight) {
  return {means.on, means.off, 0.5 * means.share_on, 0.5 * (1.0 - means.share_on), weight};
}

OnAndOff on_and_off(const std::vector<std::vector<double>>& stretches, OnAndOff chain) {
  constexpr int passes = 60;
  constexpr double least = 1e-4, most = 0.9;
  for (int pass = 0; pass < passes; ++pass) {
    Expected expected;
    for (const auto& values : stretches) smoothed(chain, values, expected);
    chain.begins = std::clamp(expected.begun / std::max(expected.before_off, 1e-9), least, most);
    chain.ends = std::clamp(expected.ended / std::max(expected.before_on, 1e-9), least, most);
    const double off = expected.value_off / std::max(expected.off, 1e-9);
    const double on = expected.value_on / std::max(expected.on, 1e-9);
    if (!(off > 0.0) || !(on > off)) break;
    chain.on = on;
    chain.off = off;
  }
  return chain;
}

}  // namespace gyrostat::gap
