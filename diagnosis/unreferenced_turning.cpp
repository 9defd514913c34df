#include <gyrostat/diagnosis/unreferenced_turning.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/starts/turning.hpp>

namespace gyrostat::gap {
namespace {

constexpr double least_extent_dps = 5.0, least_change_dps = 2.0;
constexpr double still_dps = 1.0;      // from the median
constexpr double least_rest_s = 20.0;  // that is worth to be looked at
constexpr std::size_t a_second = 4;    // means

}  // namespace

std::optional<UnreferencedTurning> turning_without_reference(const Series& recording) {
  if (!recording.rate_ref_dps.empty() || recording.size() < 2) return std::nullopt;
  UnreferencedTurning turning;
  bool comes_and_goes = false;
  std::vector<char> is_still;
  for (const auto* rate :
       {&recording.gyro_dps, &recording.cross_rate_1_dps, &recording.cross_rate_2_dps}) {
    const auto means = quarter_second_means(recording, *rate);
    if (means.size() <= a_second) continue;
    turning.extent_dps = std::max(turning.extent_dps, inner_extent(means));
    std::vector<double> changes, known;
    for (std::size_t k = a_second; k < means.size(); ++k)
      changes.push_back(means[k] - means[k - a_second]);
    comes_and_goes = comes_and_goes || inner_extent(changes) >= least_change_dps;
    std::ranges::copy_if(means, std::back_inserter(known), [](double x) { return !is_missing(x); });
    if (known.empty()) continue;
    const double middle = quantile(std::move(known), 0.5);
    is_still.resize(means.size(), 1);
    for (std::size_t k = 0; k < means.size(); ++k)
      if (std::abs(means[k] - middle) > still_dps) is_still[k] = 0;
  }
  if (turning.extent_dps < least_extent_dps || !comes_and_goes) return std::nullopt;
  std::size_t run = 0, longest = 0, end = 0;
  for (std::size_t k = 0; k < is_still.size(); ++k) {
    run = is_still[k] != 0 ? run + 1 : 0;
    if (run > longest) {
      longest = run;
      end = k + 1;
    }
  }
  // Without the second at either end, in which it stops or starts.
  const double mean_s = static_cast<double>(quarter_second(recording)) / recording.rate_hz();
  const double from_s = mean_s * static_cast<double>(end - longest) + 1.0;
  const double to_s = mean_s * static_cast<double>(end) - 1.0;
  if (to_s - from_s >= least_rest_s) {
    turning.rest_from_s = from_s;
    turning.rest_to_s = to_s;
  }
  return turning;
}

std::string in_words(const UnreferencedTurning& turning) {
  auto words = fmt::format(
      "the sensor turns by {:.3g} dps and no rate_ref_dps says how: what it turns is taken for "
      "errors",
      turning.extent_dps);
  if (turning.rest_to_s > turning.rest_from_s)
    words +=
        fmt::format("; it rests from {:.1f} to {:.1f} s: --from {:.1f} --to {:.1f}",
                    turning.rest_from_s, turning.rest_to_s, turning.rest_from_s, turning.rest_to_s);
  return words;
}

}  // namespace gyrostat::gap
