#pragma once

#include <cmath>
#include <numbers>

#include <gyrostat/analysis/innovations.hpp>
#include <gyrostat/analysis/judge/judged_steps.hpp>
#include <gyrostat/analysis/judge/product.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat::judge {

/// Innovations nu beside their variances S, as z = nu / sqrt(S); what misses either is left out, as
/// if it had not been there.
template <class T>
class Whiteness {
  static constexpr int lanes = Lanes<T>::count;
  static constexpr std::size_t lags = Innovations::lags;

 public:
  void add(const double* innovations, const double* variances, std::size_t samples) {
    if (all_missing<T>(variances, samples)) return;
    T z[lags + JudgedSteps::most];
    for (std::size_t l = 0; l < lags; ++l) z[l] = before_[l];
    T finite(0.0);
    for (std::size_t k = 0; k < samples; ++k) {
      const T S = Lanes<T>::load(variances + k * lanes);
      if (!all(S == variance_)) normalise_by(S);
      const T now = Lanes<T>::load(innovations + k * lanes) * inverse_root_;
      z[lags + k] = now;
      finite += now - now;
    }
    if (!all(finite == T(0.0))) return add_some(innovations, variances, z + lags, samples);
    add_all(variances, z, samples);
    for (std::size_t l = 0; l < lags; ++l) before_[l] = z[samples + l];
    count_ += T(static_cast<double>(samples));
  }

  Innovations of_lane(int lane) const {
    const auto at = [lane](const T& value) { return Lanes<T>::at(value, lane); };
    Innovations result;
    const double n = at(count_), squares = at(squares_);
    const Odd& odd = odd_[lane];
    result.count = static_cast<std::size_t>(n) + odd.count;
    if (result.count > 0) result.nis = (squares + odd.squares) / static_cast<double>(result.count);
    const double scored = n + static_cast<double>(odd.scored);
    if (scored > 0.0) {
      const double sum = n * std::log(2.0 * std::numbers::pi) + product_.logarithm(lane) + squares;
      result.log_score = (0.5 * sum + odd.scores) / scored;
    }
    shares(at, n, result);
    correlate(at, n, squares, result);
    return result;
  }

 private:
  /// Quantiles of the standard normal at 0.6, 0.7, 0.8 and 0.9.
  static constexpr double deciles[] = {0.25334710313579972, 0.52440051270804067,
                                       0.84162123357291429, 1.2815515655446004};

  /// What has a square but no z: an infinite nu, a variance that is not positive.
  struct Odd {
    std::size_t count = 0, scored = 0;
    double squares = 0.0, scores = 0.0;
  };

  /// A filter that has settled states the same variance again and again.
  void normalise_by(const T& S) {
    using std::sqrt;
    variance_ = S;
    inverse_root_ = any(S == S) ? T(1.0) / sqrt(S) : S;
  }

  void add_all(const double* variances, const T* z, std::size_t samples) {
    T squares = squares_;
    for (std::size_t k = 0; k < samples; ++k) {
      squares += z[lags + k] * z[lags + k];
      product_.multiply(Lanes<T>::load(variances + k * lanes));
    }
    squares_ = squares;
    T products[lags];
    for (std::size_t l = 0; l < lags; ++l) products[l] = products_[l];
    for (std::size_t k = 0; k < samples; ++k)
      unrolled<lags>([&]<int l>() { products[l] += z[lags + k] * z[k + l]; });
    for (std::size_t l = 0; l < lags; ++l) products_[l] = products[l];
    T negative = negative_, above[4], below[4];
    unrolled<4>([&]<int d>() {
      above[d] = above_[d];
      below[d] = below_[d];
    });
    for (std::size_t k = 0; k < samples; ++k) {
      const T now = z[lags + k];
      negative = one_more(now < T(0.0), negative);
      unrolled<4>([&]<int d>() {
        above[d] = one_more(now > T(deciles[d]), above[d]);
        below[d] = one_more(now < T(-deciles[d]), below[d]);
      });
    }
    negative_ = negative;
    unrolled<4>([&]<int d>() {
      above_[d] = above[d];
      below_[d] = below[d];
    });
  }

  /// The same sums in the same order for a lane that misses nothing.
  void add_some(const double* innovations, const double* variances, const T* z,
                std::size_t samples) {
    for (std::size_t k = 0; k < samples; ++k) {
      const T S = Lanes<T>::load(variances + k * lanes);
      if (!any(S == S)) continue;
      const auto present = z[k] - z[k] == T(0.0);
      if (!all(present)) add_odd(innovations + k * lanes, variances + k * lanes, z[k]);
      const T now = select(present, z[k], T(0.0));
      squares_ += now * now;
      product_.multiply(select(present, S, T(1.0)));
      for (std::size_t l = 0; l < lags; ++l) products_[l] += now * before_[l];
      for (std::size_t l = 0; l < lags; ++l)
        before_[l] = select(present, l + 1 < lags ? before_[l + 1] : now, before_[l]);
      negative_ = one_more(now < T(0.0), negative_);
      for (int d = 0; d < 4; ++d) {
        above_[d] = one_more(now > T(deciles[d]), above_[d]);
        below_[d] = one_more(now < T(-deciles[d]), below_[d]);
      }
      count_ = one_more(present, count_);
    }
  }

  void add_odd(const double* innovations, const double* variances, const T& z) {
    for (int l = 0; l < lanes; ++l) {
      const double squared = innovations[l] * innovations[l] / variances[l];
      const double of_lane = Lanes<T>::at(z, l);
      if (of_lane - of_lane == 0.0 || squared != squared) continue;
      ++odd_[l].count;
      odd_[l].squares += squared;
      const double score = 0.5 * (std::log(2.0 * std::numbers::pi * variances[l]) + squared);
      if (score != score) continue;
      ++odd_[l].scored;
      odd_[l].scores += score;
    }
  }

  template <class At>
  void shares(const At& at, double n, Innovations& result) const {
    auto& pit = result.pit;
    for (int d = 0; d < 4; ++d) {
      pit[5 + d] = (d == 0 ? n - at(negative_) : at(above_[d - 1])) - at(above_[d]);
      pit[4 - d] = (d == 0 ? at(negative_) : at(below_[d - 1])) - at(below_[d]);
    }
    pit[9] = at(above_[3]);
    pit[0] = at(below_[3]);
    for (int bin = 0; bin < static_cast<int>(Innovations::bins); ++bin)
      pit[bin] = n > 0.0 ? pit[bin] / n : no_value;
  }

  /// Ljung and Box (Biometrika 65, 1978) about the known mean zero.
  template <class At>
  void correlate(const At& at, double n, double squares, Innovations& result) const {
    if (!(n > static_cast<double>(lags)) || !(squares > 0.0)) return;
    result.lag_1 = at(products_[lags - 1]) / squares;
    result.ljung_box = 0.0;
    for (std::size_t l = 0; l < lags; ++l) {
      const double correlation = at(products_[l]) / squares;
      result.ljung_box +=
          n * (n + 2.0) * correlation * correlation / (n - static_cast<double>(lags - l));
    }
  }

  T count_{0.0}, squares_{0.0}, negative_{0.0};
  T above_[4], below_[4];
  T before_[lags];    ///< the last z, the newest at the end; zeros before the first
  T products_[lags];  ///< [l]: at lag lags - l
  T variance_{no_value}, inverse_root_{no_value};
  Product<T> product_;
  Odd odd_[lanes];

 public:
  Whiteness() {
    for (auto& one : above_) one = T(0.0);
    for (auto& one : below_) one = T(0.0);
    for (auto& one : before_) one = T(0.0);
    for (auto& one : products_) one = T(0.0);
  }
};

}  // namespace gyrostat::judge
