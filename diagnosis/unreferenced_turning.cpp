#include <gyrostat/diagnosis/unreferenced_turning.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <gyrostat/core/step.hpp>
#include <gyrostat/core/values.hpp>
#include <gyrostat/diagnosis/starts/quantile.hpp>
#include <gyrostat/diagnosis/starts/turning.hpp>

namespace gyrostat::gap {
namespace {

constexpr double least_extent_dps = 5.0, least_change_dps = 2.0;
constexpr double still_dps = 1.0;
constexpr double least_rest_s = 20.0;  // that is worth to be looked at alone
// In quarters of a second.
constexpr std::size_t second = 4, aside = 2, shortest_rest = 8;

constexpr std::array rates = {&Series::gyro_dps, &Series::cross_rate_1_dps,
                              &Series::cross_rate_2_dps};

bool is_steady(const std::vector<double>& means, std::size_t k) {
  const auto near = [&](std::size_t other) {
    return std::abs(means[k] - means[other]) < still_dps;
  };
  return (k < second || near(k - second)) && (k + second >= means.size() || near(k + second));
}

/// What an axis shows at rest: of all means that are steady the middle of those about the one
/// nearest to zero.
std::optional<double> level_at_rest(const std::vector<double>& means) {
  std::vector<double> steady;
  for (std::size_t k = 0; k < means.size(); ++k)
    if (is_steady(means, k)) steady.push_back(means[k]);
  if (steady.empty()) return std::nullopt;
  const double nearest =
      *std::ranges::min_element(steady, {}, [](double mean) { return std::abs(mean); });
  std::erase_if(steady, [&](double mean) { return std::abs(mean - nearest) > 2.0 * still_dps; });
  return quantile(std::move(steady), 0.5);
}

/// Flags runs of still quarters, without what is beside a turn.
void flag_rests(const std::vector<char>& is_still, std::size_t quarter, std::vector<char>& flags) {
  for (std::size_t k = 0; k < is_still.size();) {
    std::size_t end = k;
    while (end < is_still.size() && is_still[end] != 0) ++end;
    const std::size_t from = k == 0 ? 0 : k + aside;
    const std::size_t to = end == is_still.size() ? end : end - std::min(end, aside);
    if (to >= from + shortest_rest)
      std::fill(flags.begin() + static_cast<std::ptrdiff_t>(from * quarter),
                flags.begin() + static_cast<std::ptrdiff_t>(to * quarter), 1);
    k = end + 1;
  }
}

/// Whether each quarter of the recording has two seconds of rest, and all have two fifths of it:
/// what is looked for in one part is judged on another.
bool is_all_over(const UnreferencedTurning& turning, double rate_hz) {
  constexpr std::size_t parts = 4;
  constexpr double least_s = 2.0, least_share = 0.4;
  const std::size_t length = turning.at_rest.size() / parts;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto first = turning.at_rest.begin() + static_cast<std::ptrdiff_t>(part * length);
    const auto rest = std::count(first, first + static_cast<std::ptrdiff_t>(length), 1);
    if (static_cast<double>(rest) < least_s * rate_hz) return false;
  }
  return turning.rest_s * rate_hz >= least_share * static_cast<double>(turning.at_rest.size());
}

}  // namespace

UnreferencedTurning turning_without_reference(const Series& recording) {
  if (!recording.rate_ref_dps.empty() || recording.size() < 2) return {};
  double extent_dps = 0.0;
  bool comes_and_goes = false;
  std::vector<char> is_still;
  for (const auto rate : rates) {
    const auto means = quarter_second_means(recording, recording.*rate);
    if (means.size() <= second) continue;
    extent_dps = std::max(extent_dps, inner_extent(means));
    std::vector<double> changes;
    for (std::size_t k = second; k < means.size(); ++k)
      changes.push_back(means[k] - means[k - second]);
    comes_and_goes = comes_and_goes || inner_extent(changes) >= least_change_dps;
    const auto level = level_at_rest(means);
    is_still.resize(means.size(), 1);
    for (std::size_t k = 0; k < means.size(); ++k)
      if (!level || !(std::abs(means[k] - *level) < still_dps)) is_still[k] = 0;
  }
  if (extent_dps < least_extent_dps || !comes_and_goes) return {};
  UnreferencedTurning turning{.extent_dps = extent_dps,
                              .at_rest = std::vector<char>(recording.size(), 0)};
  flag_rests(is_still, quarter_second(recording), turning.at_rest);
  turning.rest_s =
      static_cast<double>(std::ranges::count(turning.at_rest, 1)) / recording.rate_hz();
  return turning;
}

Series without_turning(Series recording, std::vector<std::string>& told) {
  const auto turning = turning_without_reference(recording);
  if (!turning) return recording;
  const auto turns = fmt::format("the sensor turns by {:.3g} dps and no rate_ref_dps says how",
                                 turning.extent_dps);
  if (turning.rest_s < least_rest_s || !is_all_over(turning, recording.rate_hz())) {
    told.push_back(turns + ": what it turns is taken for errors");
    return recording;
  }
  told.push_back(fmt::format("{}: of its {:.4g} s the {:.3g} s at rest are looked at", turns,
                             recording.duration_s(), turning.rest_s));
  for (const auto rate : rates)
    for (std::size_t i = 0; i < (recording.*rate).size(); ++i)
      if (turning.at_rest[i] == 0) (recording.*rate)[i] = no_value;
  recording.heading_deg.clear();
  recording.mag_valid.clear();
  return recording;
}

}  // namespace gyrostat::gap
