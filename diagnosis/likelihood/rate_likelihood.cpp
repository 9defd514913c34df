#include <gyrostat/diagnosis/likelihood/rate_likelihood.hpp>

#include <cmath>
#include <utility>

#include <gyrostat/diagnosis/likelihood/slow_law.hpp>

namespace gyrostat::gap {

double fast_ratio(const ReducedRate& reduced, const NoiseLaw& law) {
  const auto& seen = reduced.periodogram();
  if (seen.empty()) return 1.0;
  const auto density = reduced.grid().shown(density_of(law, reduced.grid().angles()));
  double sum = 0.0, bins = 0.0;
  for (std::size_t k = reduced.grid().first_fast_bin(); k + 1 < density.size(); ++k)
    sum += seen[k] / density[k], bins += 1.0;
  return sum / bins;
}

RateBands rate_bands(const ReducedRate& reduced, const NoiseLaw& law, DensityParts near) {
  const auto bands = bands_of(law, reduced.cluster_s());
  auto density = density_of(bands.fast, reduced.grid().angles(), near);
  RateBands found{.slow = slow_law_of(reduced, bands, density, near.gain_of_white),
                  .fast = {},
                  .parts = std::move(near)};
  const auto& seen = reduced.periodogram();
  if (seen.empty()) return found;
  const auto slow_density = density_of(bands.slow, reduced.grid().angles());
  for (std::size_t k = 0; k < density.size(); ++k) density[k] += slow_density[k];
  density = reduced.grid().shown(density);
  double sum = 0.0;
  for (std::size_t k = reduced.grid().first_fast_bin(); k + 1 < density.size(); ++k) {
    const double log_density = std::log(density[k]);
    found.fast.log_density.push_back(log_density);
    sum += log_density + seen[k] / density[k];
  }
  found.fast.log_likelihood = -reduced.degrees() * sum;
  return found;
}

SlowTerms slow_terms(const ReducedRate& reduced, const SlowLaw& law,
                     const Eigen::MatrixXd& regressors, const Eigen::VectorXd& prior_std,
                     const SlowTerms* near, bool is_the_last) {
  const auto& slow = reduced.slow(Part::train);
  if (slow.points.size() < 2) return {};
  Eigen::MatrixXd chosen(slow.means.size(), regressors.cols());
  for (Eigen::Index k = 0; k < chosen.rows() && chosen.cols() > 0; ++k)
    chosen.row(k) =
        regressors.row(static_cast<Eigen::Index>(slow.points[static_cast<std::size_t>(k)]));
  return slow_terms(law, slow.points, slow.means, chosen, prior_std, near, is_the_last);
}

}  // namespace gyrostat::gap
