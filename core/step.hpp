#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// How one step of a filter went. Everything after `no_measurement` is a numerical breakdown: the
/// filter kept its last sound state and goes on, and the step is counted.
enum class Status {
  ok,
  no_measurement,         ///< nothing to update with at this sample
  risk_breakdown,         ///< P^-1 - 2 mu is not positive definite: the risk update was left out
  indefinite_covariance,  ///< a root of the covariance does not exist: the step was left out
  not_finite,             ///< the step would have produced NaN or infinity: it was left out
};

inline constexpr std::array<std::string_view, 5> status_names = {
    "ok", "no_measurement", "risk_breakdown", "indefinite_covariance", "not_finite"};

inline constexpr std::string_view name_of(Status status) {
  return status_names[static_cast<std::size_t>(status)];
}

inline constexpr bool is_breakdown(Status status) { return status > Status::no_measurement; }

/// The status of a step on T: one, or on a pack one a lane, held as the numbers of a pack so that
/// masks can set them.
template <class T>
struct StatusOf {
  using type = Status;
};
template <class T>
requires requires { T::lanes; }
struct StatusOf<T> {
  struct type {
    T code;
    type(Status status = Status::ok) : code(static_cast<double>(status)) {}  // NOLINT
  };
};

/// Where the mask holds the status is `value`.
template <class S>
void set_status(S& status, bool mask, Status value) {
  if (mask) status = value;
}
template <class S, class M>
void set_status(S& status, const M& mask, Status value) {
  status.code = select(mask, S(value).code, status.code);
}

/// Where the status is a breakdown.
inline bool broken(Status status) { return is_breakdown(status); }
template <class S>
auto broken(const S& status) {
  return status.code > S(Status::no_measurement).code;
}

/// What a filter is given at one sample. `true_rate_dps` and `true_drift_dps` exist in simulation
/// only and are for the oracle.
template <class T>
struct Sample {
  T t_s{no_value};
  T gyro_dps{no_value};
  T temperature_C{no_value};
  T heading_deg{no_value};  ///< no value where the compass may not be used
  T true_rate_dps{no_value};
  T true_drift_dps{no_value};
};

/// What a filter answers at one sample. The estimate is of the gyro's error, in dps: the
/// compensated rate is gyro - estimate. No innovation (NaN) where there was no update.
template <class T>
struct Step {
  T estimate_dps{0.0};
  T estimate_variance{no_value};
  T innovation_dps{no_value};
  T innovation_variance{no_value};
  typename StatusOf<T>::type status = Status::ok;
};

template <class T>
Mask<T> is_missing(const T& value) {
  using std::isnan;
  return isnan(value);
}

/// How a filter that carries phi, delta1 and delta2 as unknowns holds them.
template <class T>
struct Learned {
  T phi{no_value};
  T phi_std{no_value};
  T delta1_dps{no_value};
  T delta2_dps{no_value};
};
using LearnedParameters = Learned<double>;

/// The channels that a filter cannot do without.
struct Needs {
  bool temperature = false;
  bool heading = false;
  bool truth = false;
};

/// What a filter is compared as.
struct Role {
  enum class Rank {
    floor,      ///< what doing nothing costs
    contender,  ///< what one could use
    bound,      ///< knows what no gyro tells: no contender can be better
  };
  enum class Corrects { random_error, thermal_drift };

  Rank rank = Rank::contender;
  Corrects corrects = Corrects::random_error;
  int published =
      0;  ///< its place among the methods of study [A], or of [B] for drift; 0: in neither

  constexpr bool is_contender() const { return rank == Rank::contender; }
  constexpr bool is_floor() const { return rank == Rank::floor; }
  constexpr bool is_bound() const { return rank == Rank::bound; }
};

/// A compensation filter: a small copyable value that turns samples into steps.
template <class F>
concept Filter = std::copyable<F> && requires(F filter, Sample<typename F::Scalar> sample) {
  typename F::Parameters;
  { F::needs } -> std::convertible_to<Needs>;
  { F::role } -> std::convertible_to<Role>;
  { F::title } -> std::convertible_to<std::string_view>;
  { filter.step(sample) } -> std::same_as<Step<typename F::Scalar>>;
};

/// Whether a filter's estimates are Monte Carlo draws: it says so by a static `draws_noise`.
template <class F>
inline constexpr bool draws_noise = requires {
  F::draws_noise;
};

}  // namespace gyrostat
