#pragma once

#include <string_view>
#include <vector>

#include <gyrostat/diagnosis/gap/instrument.hpp>

namespace gyrostat::gap {

/// One coordinate at which readings leave the ensemble's own spread.
struct Departure {
  Eigen::Index reading;
  double z;
  double p_adjusted;  ///< family-wise, over all readings
};

/// Readings of many replicas of one simulator, and how far other readings lie from them.
///
/// A recording's simulator was fitted to it. So that a recording made by that simulator looks like
/// any replica, every replica is refitted too, in the linear approximation: with J the change of
/// the mean readings with the fitted parameters, J (J' W J)^-1 J' W of a deviation is what a refit
/// would take away. J may have no columns.
class Ensemble {
 public:
  /// `replicas` is readings x replicas, at least ten of them.
  Ensemble(const Instrument& instrument, const Eigen::MatrixXd& replicas,
           const Eigen::MatrixXd& jacobian);

  const std::vector<LensView>& lenses() const { return lenses_; }
  const Eigen::VectorXd& mean() const { return mean_; }
  const Eigen::VectorXd& spread() const { return spread_; }
  /// What of each spread the replicas do not have: 0 where they vary by more than the least that
  /// their lens is credited with, 1 where they do not vary.
  const Eigen::VectorXd& credited() const { return credited_; }

  /// Deviations from the mean in units of the spread, refitted.
  Eigen::VectorXd deviations(const Eigen::VectorXd& readings) const;
  /// How far the mean square deviation in each lens lies from a replica's, in spreads of its
  /// logarithm; negative where a lens sees less variety than the simulator has.
  Eigen::VectorXd lens_deviations(const Eigen::VectorXd& deviations) const;
  /// Probability of a replica as far off. Of each lens, the mean square deviation and the largest
  /// deviation are held against the other replicas' (log-normal above, chi-squared of no more
  /// degrees than readings below, and Gumbel, by moments); the least of these probabilities is
  /// ranked among the replicas' own least ones, and beyond them goes on in proportion.
  double p_value(const Eigen::VectorXd& readings) const { return p_value_without({}, readings); }
  /// As far off in any lens but those of one channel, among lenses of every one.
  double p_value_without(std::string_view channel, const Eigen::VectorXd& readings) const;
  /// Readings that leave the spread with a family-wise probability below `level`.
  std::vector<Departure> departures(const Eigen::VectorXd& readings, double level) const;
  /// Deviations decorrelated within each lens, by the shrunk covariance of the replicas.
  Eigen::VectorXd whitened(const Eigen::VectorXd& readings) const;

 private:
  struct Tail {
    double centre, spread, degrees, location, width;
  };
  /// What a column of readings lacks of the credited spread, drawn.
  Eigen::VectorXd made_up(std::uint64_t column) const;
  /// In lenses of any channel but one.
  double least_probability(const Eigen::VectorXd& deviations, const std::vector<Tail>& tails,
                           std::string_view without = {}) const;
  double log_mean_square(const Eigen::VectorXd& deviations, const LensView& lens) const;

  std::vector<LensView> lenses_;
  Eigen::VectorXd mean_, spread_, credited_;
  Eigen::VectorXd lacking_,
      mean_made_up_;  ///< spread that is credited, and the replicas' mean draw of it
  Eigen::MatrixXd refit_left_, refit_right_;  ///< J, and (J' W J)^-1 J' W
  std::vector<Tail> tails_;
  std::vector<double> replica_least_;    ///< sorted
  std::vector<double> replica_largest_;  ///< largest |z| of each replica, sorted
  std::vector<Eigen::MatrixXd> roots_;   ///< Cholesky factors of the correlations, a lens each
};

}  // namespace gyrostat::gap
