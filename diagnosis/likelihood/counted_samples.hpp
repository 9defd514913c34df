#pragma once

#include <cstddef>
#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>

namespace gyrostat::gap {

/// Which samples of a recording count, and what periodograms show of a density through the gaps
/// between them.
class CountedSamples {
 public:
  /// Samples that are `masked` (one flag a sample) do not count; covariances are looked at up to so
  /// many lags, 0 included.
  CountedSamples(const Conditions& conditions, std::vector<char> masked, std::size_t lags);

  const std::vector<char>& masked() const { return masked_; }
  bool are_all() const { return !hides_any_; }
  /// Share of the train part's samples that count.
  double share() const { return share_; }
  bool are_all_of_train() const { return pairs_.empty(); }
  /// Whether those that do not come evenly: then what is slow shows elsewhere, too.
  bool come_evenly() const { return come_evenly_; }
  /// Whether this sample, which does not count, is taken to be halfway between its neighbours, as
  /// those are that stand alone and do not come evenly. The others are zeros: of noise that changes
  /// little from sample to sample, they spread what is slow over all frequencies.
  bool is_halfway(std::size_t sample) const { return !halfway_.empty() && halfway_[sample] != 0; }
  /// The density of the samples that count, with zeros and halves for the others, under a density
  /// of all, at evenly spaced angles from 0 to pi; not where all of the train part do.
  std::vector<double> density(std::vector<double> of_all) const;

 private:
  void count_pairs(const Conditions& conditions, std::size_t lags);
  void put_halfway(const Conditions& conditions);

  std::vector<char> masked_;
  bool hides_any_, come_evenly_ = false;
  double share_ = 1.0;
  std::vector<double> pairs_;           ///< share of pairs at each lag that both count; empty: all
  std::vector<char> halfway_;           ///< a flag a sample; empty: none
  std::vector<double> beside_halfway_;  ///< share of pairs of one that counts and one halfway
  std::vector<double> both_halfway_;
};

}  // namespace gyrostat::gap
