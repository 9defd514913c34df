#pragma once

#include <array>

#include <gyrostat/diagnosis/gap/ensemble.hpp>

namespace gyrostat::gap {

/// How well a simulator foretells readings.
struct LogScore {
  double value = 0.0;                   ///< of the recording
  double expected = 0.0;                ///< of a replica of that simulator itself
  double spread = 1.0;                  ///< of such a replica's
  Eigen::VectorXd each, expected_each;  ///< a reading each
  double typical_shortfall = 0.0;       ///< of such a replica: nine of ten have less
  double rare_shortfall = 0.0;          ///< and 39 of 40 less than that

  /// How many spreads the recording scores below a replica.
  double deficit() const { return (expected - value) / spread; }
  /// What fitting so many parameters to the recording wins without cause.
  double penalty(std::size_t parameters) const { return 1.0 * static_cast<double>(parameters); }
};

/// Log scores of one recording's readings under different simulators (a synthetic likelihood; Wood,
/// Nature 466, 2010): whitened by the baseline's replicas, each reading has Student's t with five
/// degrees of freedom about the simulator's mean, with its spread. A tenth of how far the recording
/// lies from the baseline is forgiven, to every simulator alike: an effect may be right though its
/// form is not exactly nature's.
class Scoring {
 public:
  Scoring(const Ensemble& baseline, const Eigen::VectorXd& observed);

  static constexpr double temperature = 3.0;  ///< readings of different lenses repeat one another

  LogScore of(const Eigen::MatrixXd& replicas) const;
  /// The spread of plain readings that a fit should count in.
  Eigen::VectorXd spread(const Eigen::MatrixXd& replicas) const;

 private:
  const Ensemble& baseline_;
  Eigen::VectorXd observed_, plain_observed_, forgiven_;
};

/// The gap of a simulator, in spreads of a true one's readings: with n_i the nats by which the
/// score of reading i falls short of what a true simulator expects of its own replicas, and z^2 = 5
/// (exp(n / 3) - 1) the squared deviation that costs as much, the root mean square of z beyond that
/// of a replica. A reading that a simulator of too much variety leaves open counts as well as one
/// that it misses; a recording that `truth` made has a gap of 0.
double gap_of(const LogScore& score, const LogScore& truth);

/// Whether one in forty of the recordings that `truth` makes has a larger gap.
bool may_be_closed(const LogScore& score, const LogScore& truth);

/// 95 % interval of 1 - gap after / gap before when the readings of every lens are drawn again.
std::array<double, 2> bootstrap_closed(const Instrument& instrument, const LogScore& before,
                                       const LogScore& after, const LogScore& truth,
                                       std::uint64_t seed);

}  // namespace gyrostat::gap
