#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gyrostat/core/interrupt.hpp>
#include <gyrostat/diagnosis/likelihood/dials.hpp>
#include <gyrostat/diagnosis/likelihood/rate_likelihood.hpp>
#include <gyrostat/generators/scenario.hpp>

namespace gyrostat::gap {

/// A scenario with the parameters under which a recording is likeliest.
struct SetFit {
  Scenario scenario;
  double log_likelihood = -1e300;
  Eigen::VectorXd drift;  ///< coefficients of Conditions::drift_regressors() without the constant
  std::size_t parameters = 0;
};

/// Between which values a parameter of a scenario's effect lies with 95 %.
struct ParameterInterval {
  std::size_t effect, field;  ///< numbers, in the scenario and of the effect
  double low, high;
};

/// What samples within clusters say of an amplitude of a slow effect, which is taken out of the
/// recording with this size: clusters move it within its standard error.
struct KnownSize {
  std::string effect;
  std::size_t field;
  double size, error;
};

/// Whether jumps are followed, or stood in for by a Gaussian law of the same covariance.
enum class Jumping { no, yes };

/// The law of what is random in a scenario's rate error.
NoiseLaw law_of(const Scenario& scenario, double interval_s);

/// Fits sets of effects to the train part of one reduced recording. Moved are the white noise, the
/// random walk and, of each effect with a law or a slow signature, its free parameters; amplitudes
/// of slow signatures are found by least squares. Effects
/// whose signature is not slow must have been taken out of the recording.
class SetFitter {
 public:
  SetFitter(const Conditions& conditions, std::shared_ptr<const ReducedRate> reduced,
            Interrupt interrupt = {}, std::vector<KnownSize> known = {});
  /// One that has further regressors of unknown size (cluster x any) beside every set.
  SetFitter beside(const Eigen::MatrixXd& further) const {
    return SetFitter(conditions_, reduced_, interrupt_, known_, further);
  }
  /// The most likely size of each of them under a scenario, in units of the regressor.
  Eigen::VectorXd further_sizes(const Scenario& scenario) const;

  const ReducedRate& reduced() const { return *reduced_; }
  /// Standard deviation of all cluster means.
  double slow_deviation_dps() const { return amplitude_dps_; }
  /// Fisher scoring from `start`, damped (Levenberg and Marquardt), for at most `iterations`; what
  /// dials move that are `held` stays as it is.
  SetFit maximise(const Scenario& start, int iterations, Jumping jumping = Jumping::yes,
                  const std::function<bool(const Dial&)>& held = {}) const;
  /// Of what a fit moves or finds by least squares, from the information of its likelihood
  /// (Kay, "Fundamentals of Statistical Signal Processing: Estimation Theory", 1993, 3.7 and 15.7),
  /// jumps as a Gaussian law of their covariance.
  std::vector<ParameterInterval> intervals(const SetFit& fit) const;
  /// Of the first amplitude of a scenario's slow effect, in the unit of its field: its standard
  /// error over what the walk may be, and the standard deviation that is expected of it beforehand.
  struct Amplitude {
    double error, prior;
  };
  Amplitude amplitude_of(const Scenario& scenario, std::size_t effect) const;
  /// With as much white noise as the fast part calls for, all else as it is.
  Scenario with_white_noise_scaled(Scenario scenario) const;
  /// From the terms of a scenario `near` this one, where there is one (slow_terms).
  RateTerms terms(const Scenario& scenario, Jumping jumping = Jumping::yes,
                  const SlowTerms* near = nullptr) const;

 private:
  SetFitter(const Conditions& conditions, std::shared_ptr<const ReducedRate> reduced,
            Interrupt interrupt, std::vector<KnownSize> known, const Eigen::MatrixXd& further);

  const Conditions& conditions_;
  std::shared_ptr<const ReducedRate> reduced_;
  Interrupt interrupt_;
  std::vector<KnownSize> known_;
  /// Columns of unit spread: the drift's regressors, and the signatures of the scenario's slow
  /// effects.
  struct Regressors {
    Eigen::MatrixXd columns;
    std::vector<double> spreads;      ///< that they had
    std::vector<double> errors = {};  ///< of sizes that are known, by columns; 0: it is not
  };
  const KnownSize* known(const Effect& effect, std::size_t field) const;
  /// Derivatives by each dial: of what a likelihood is made of, whose products are its information
  /// from cluster means and from what is faster, and of both parts' logarithms.
  struct Slopes {
    Eigen::MatrixXd slow, fast;
    Eigen::VectorXd slow_gradient, fast_gradient;
  };
  Slopes slopes_of(const Scenario& scenario, const std::vector<Dial>& dials, const RateTerms& here,
                   Jumping jumping) const;
  /// Mean and standard deviation of the regressors' coefficients over what the walk may be: a
  /// small one is hardly seen, and spreads them all the same. Its prior is flat in its size.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> coefficients_over_walks(
      const Scenario& scenario) const;
  Regressors regressors_of(const Scenario& scenario) const;
  NoiseLaw law_for(const Scenario& scenario, Jumping jumping) const;
  SlowTerms slow_terms_of(const SlowLaw& law, const Regressors& regressors,
                          const SlowTerms* near = nullptr, bool is_the_last = false) const;
  Eigen::VectorXd fixed_signature(const Scenario& alone) const;
  void take_coefficients(const RateTerms& terms, SetFit& fit) const;

  mutable std::mutex mutex_;
  /// Of an effect with its parameters.
  mutable std::map<std::pair<std::string, std::vector<double>>, Eigen::VectorXd> fixed_;
  Series slow_series_;
  Eigen::MatrixXd drift_, further_;  ///< of unit spread, further_ about its mean
  Eigen::VectorXd further_spreads_;
  std::vector<double> drift_spreads_;
  double amplitude_dps_;  ///< to be expected of a slow signature
};

}  // namespace gyrostat::gap
