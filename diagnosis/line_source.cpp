#include <gyrostat/diagnosis/line_source.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gyrostat/analysis/spectra/coherence.hpp>

namespace gyrostat::gap {
namespace {

constexpr double significance = 0.001, suspicion = 0.05;
constexpr std::size_t fewest_segments = 8, wished_segments = 32;
constexpr std::size_t shortest = 32, longest = 4096;
constexpr double most_bins_aside = 8.0;

struct Width {
  std::string_view effect, centre, half;  ///< fields; no width: a pure tone
};
constexpr Width line_widths[] = {{"sinusoidal", "frequency_hz", ""},
                                 {"vibration", "centre_hz", "bandwidth_hz"},
                                 {"vibration_bursts", "centre_hz", "bandwidth_hz"},
                                 {"wandering_line", "frequency_hz", "wander_hz"}};

double field_of(const Effect& effect, std::string_view name) {
  for (std::size_t f = 0; f < effect.fields().size(); ++f)
    if (effect.fields()[f].name == name) return effect.value(f);
  return 0.0;
}

/// What stands beside the gyro, and whether it feels shaking that is no rotation.
struct Beside {
  const Channel* channel;
  bool is_accelerometer;
};

std::vector<Beside> beside_gyro(const Series& recording) {
  std::vector<Beside> found;
  for (const auto& channel : channels) {
    const bool accelerometer = channel.name.starts_with("acc_");
    if ((accelerometer || channel.name.starts_with("cross_rate_")) &&
        !(recording.*channel.values).empty())
      found.push_back({&channel, accelerometer});
  }
  return found;
}

/// The most coherent of the channels, over the frequencies of the line.
struct Strongest {
  Coherence coherence;
  const Channel* channel = nullptr;
  std::size_t looked_at = 0;

  double p_value() const {
    return channel == nullptr
               ? 1.0
               : std::min(1.0, chance_of(coherence) * static_cast<double>(looked_at));
  }
};

Strongest strongest(const Series& recording, const std::vector<Beside>& beside, bool accelerometer,
                    double centre_hz, double half_hz) {
  const double rate_hz = recording.rate_hz();
  auto length = std::clamp(std::bit_floor(recording.size() / wished_segments), shortest, longest);
  while (length > shortest && half_hz * static_cast<double>(length) > most_bins_aside * rate_hz)
    length /= 2;
  const double bin_hz = rate_hz / static_cast<double>(length);
  const double reach = std::ceil(half_hz / bin_hz);
  Strongest best;
  for (double k = -reach; k <= reach; ++k) {
    const double frequency_hz = centre_hz + k * bin_hz;
    if (frequency_hz < bin_hz || frequency_hz > 0.5 * rate_hz - bin_hz) continue;
    for (const auto& one : beside) {
      if (one.is_accelerometer != accelerometer) continue;
      const auto found = coherence(recording.gyro_dps, recording.*one.channel->values,
                                   frequency_hz / rate_hz, length);
      if (found.segments < fewest_segments) continue;
      ++best.looked_at;
      if (best.channel == nullptr || found.squared > best.coherence.squared) {
        best.coherence = found;
        best.channel = one.channel;
      }
    }
  }
  return best;
}

std::optional<LineWitness> witness_of(const Series& recording, const std::vector<Beside>& beside,
                                      const Effect& effect) {
  const auto line = std::find_if(std::begin(line_widths), std::end(line_widths),
                                 [&](const auto& w) { return w.effect == effect.id(); });
  if (line == std::end(line_widths)) return std::nullopt;
  const double centre_hz = field_of(effect, line->centre), half_hz = field_of(effect, line->half);
  const auto felt = strongest(recording, beside, true, centre_hz, half_hz);
  const auto turned = strongest(recording, beside, false, centre_hz, half_hz);
  if (felt.channel == nullptr && turned.channel == nullptr) return std::nullopt;
  const bool is_felt = felt.p_value() < significance, is_turned = turned.p_value() < significance;
  const auto& most = is_felt || (felt.channel != nullptr && !is_turned) ? felt : turned;
  const bool may_be_felt = (felt.channel == nullptr ? turned : felt).p_value() < suspicion;
  const auto source = is_felt       ? LineSource::mechanical
                      : may_be_felt ? LineSource::undecided
                                    : LineSource::electronic;
  return LineWitness{.effect = std::string(effect.id()),
                     .frequency_hz = centre_hz,
                     .source = source,
                     .channel = std::string(most.channel->name),
                     .coherence = most.coherence.squared,
                     .has_accelerometer = felt.channel != nullptr,
                     .p_value = most.p_value()};
}

}  // namespace

std::string_view name_of(LineSource source) {
  switch (source) {
    case LineSource::mechanical:
      return "mechanical";
    case LineSource::electronic:
      return "electronic";
    case LineSource::undecided:
      break;
  }
  return "undecided";
}

std::vector<LineWitness> line_sources(const Series& recording, const std::vector<Effect>& effects) {
  const auto beside = beside_gyro(recording);
  std::vector<LineWitness> lines;
  for (const auto& effect : effects)
    if (auto line = witness_of(recording, beside, effect)) lines.push_back(*std::move(line));
  return lines;
}

std::string in_words(const std::vector<LineWitness>& lines) {
  std::vector<std::string> words, seen_nowhere;
  std::map<std::string, std::vector<std::string>> felt;  // by channel
  for (const auto& line : lines) {
    const auto name = fmt::format("{} at {:.3g} Hz", line.effect, line.frequency_hz);
    const auto where = line.channel.starts_with("acc_") ? line.channel : "the rate of another axis";
    const auto seen = fmt::format("{}, too (coherence {:.2g})", where, line.coherence);
    const bool is_there = line.p_value < significance;
    if (line.source == LineSource::mechanical)
      felt[where].push_back(fmt::format("{} (coherence {:.2g})", name, line.coherence));
    else if (line.source == LineSource::undecided)
      words.push_back(fmt::format(
          "The {} is {} in {}; a longer recording{} would tell whether the sensor is shaken.", name,
          is_there ? "clearly" : "perhaps", seen,
          line.has_accelerometer ? "" : " with an accelerometer beside it"));
    else if (is_there)
      words.push_back(
          fmt::format("The {} is in {}, and not in the accelerometer: electronic, "
                      "unless it is a pure rotation.",
                      name, seen));
    else
      seen_nowhere.push_back(name);
  }
  for (const auto& [where, names] : felt)
    words.push_back(fmt::format("In {}, too: {}; mechanical, the sensor is shaken.", where,
                                fmt::join(names, ", ")));
  if (!seen_nowhere.empty())
    words.push_back(
        fmt::format("In no channel beside the gyro: {}; electronic, unless it is a "
                    "pure rotation about this axis.",
                    fmt::join(seen_nowhere, ", ")));
  return fmt::format("{}", fmt::join(words, " "));
}

}  // namespace gyrostat::gap
