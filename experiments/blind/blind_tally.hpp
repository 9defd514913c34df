#pragma once

#include <map>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>
#include <gyrostat/experiments/blind/set_score.hpp>
#include <gyrostat/experiments/blind/share.hpp>

namespace gyrostat::gap {

/// How often each name was given.
using Counts = std::map<std::string, double>;

/// What answers on recordings of a kind were.
struct Tally {
  Share detected, first, all_named, covered, abstained, unknown_alone;
  double members = 0, unknown = 0, none = 0;
  std::vector<double> closed;
  Counts named, named_without;
  std::vector<double> lost_by_a_name;  ///< log scores

  Tally& operator+=(const Tally& t);
  double mean_members() const { return members / first.count; }
  TableCell median_closed() const;

  void add(const Scored& scored);
  /// One without the effect of the recording in its catalogue.
  void add_left_out(const Scored& scored, const BlindAnswer& without);
};

/// "thermal_lag (second_order_lag)".
std::string name_of(const BlindLabel& label);
/// "strong", "none", "two effects, strong".
std::string kind_of(const BlindLabel& label);
/// Names but one, with how often each was given.
std::string in_words(const Counts& named, const std::string& but = "");
std::string in_order(std::vector<double> values);

}  // namespace gyrostat::gap
