#include <gyrostat/diagnosis/compare/matched.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/cause_type.hpp>
#include <gyrostat/diagnosis/compare/segments.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t fewest_to_compare = 4096;
constexpr double most_apart = 0.01;  ///< rates of sampling
constexpr std::size_t held_out_blocks = 2;
/// A held-out part is read in so many pieces, so that their spread is known.
constexpr std::size_t pieces_of_a_part = 4;

void require_comparable(const NamedSeries& trace, const NamedSeries& first) {
  if (trace.series.size() < fewest_to_compare)
    throw InputError(trace.name, fmt::format("{} samples; at least {} are needed to compare a "
                                             "simulator with a recording",
                                             trace.series.size(), fewest_to_compare));
  const double rate = trace.series.rate_hz(), of_first = first.series.rate_hz();
  if (std::abs(rate / of_first - 1.0) > most_apart)
    throw InputError(trace.name,
                     fmt::format("sampled at {:.6g} Hz, {} at {:.6g} Hz; simulate at the rate of "
                                 "the recording (within 1 %), since a filter between rates would "
                                 "pass for an effect",
                                 rate, first.name, of_first));
  const auto& z = trace.series.gyro_dps;
  const auto there = std::find_if(z.begin(), z.end(), [](double v) { return !is_missing(v); });
  if (std::all_of(there, z.end(), [&](double v) { return is_missing(v) || v == *there; }))
    throw InputError(trace.name, "gyro_dps never changes; there is nothing to compare");
}

}  // namespace

Matched match(const std::vector<NamedSeries>& recordings, const std::vector<NamedSeries>& simulated,
              std::vector<std::string> without) {
  if (recordings.empty()) throw InputError("recordings", "there are none");
  if (simulated.empty()) throw InputError("--simulated", "there are no traces");
  const NamedSeries& first = recordings.front();
  Matched matched;
  matched.rate_hz = first.series.rate_hz();
  matched.without = std::move(without);
  std::size_t shortest = first.series.size();
  for (const auto* side : {&recordings, &simulated})
    for (const auto& trace : *side) {
      require_comparable(trace, first);
      shortest = std::min(shortest, trace.series.size());
    }
  matched.segment = shortest / Conditions::blocks;
  for (const auto* side : {&recordings, &simulated})
    for (const auto& trace : *side) {
      const Conditions conditions(trace.series);
      matched.segment = std::min(matched.segment, longest_segment(conditions));
      for (const auto& cause : cause_types()) {
        if (std::ranges::find(matched.without, cause.id) != matched.without.end()) continue;
        if (auto why = cause.why_not_assessable(conditions); !why.empty()) {
          matched.without.emplace_back(cause.id);
          matched.not_assessable.push_back({std::string(cause.id), trace.name + ": " + why});
        }
      }
    }
  matched.piece = held_out_blocks * matched.segment / pieces_of_a_part;
  matched.compared = std::max(1.0, static_cast<double>(cause_types().size()) -
                                       static_cast<double>(matched.without.size()) + 2.0);
  return matched;
}

}  // namespace gyrostat::gap
