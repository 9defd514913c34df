#include "core/random.hpp"

#include <Random123/philox.h>

#include <array>
#include <cmath>
#include <numbers>

namespace gyrostat {
namespace {

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3U;
  return hash;
}

r123::Philox4x32::ctr_type words(std::uint64_t seed, std::uint64_t stream_hash,
                                 std::uint32_t trial, std::uint64_t block) {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(block), trial, static_cast<std::uint32_t>(stream_hash),
       static_cast<std::uint32_t>(stream_hash >> 32U)}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
  return r123::Philox4x32{}(counter, key);
}

double to_unit(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

std::array<double, 4> normals(const r123::Philox4x32::ctr_type& w) {
  std::array<double, 4> out{};
  for (std::size_t pair = 0; pair < 2; ++pair) {
    const double radius = std::sqrt(-2.0 * std::log(to_unit(w[2 * pair])));
    const double angle = 2.0 * std::numbers::pi * to_unit(w[2 * pair + 1]);
    out[2 * pair] = radius * std::cos(angle);
    out[2 * pair + 1] = radius * std::sin(angle);
  }
  return out;
}

}  // namespace

NormalStream::NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream)
    : seed_(seed), stream_hash_(fnv1a(stream)), trial_(trial) {}

double NormalStream::normal(std::uint64_t sample) const {
  return normals(words(seed_, stream_hash_, trial_, sample / 4))[sample % 4];
}

void NormalStream::fill(std::uint64_t first, std::span<double> out) const {
  std::size_t i = 0;
  while (i < out.size()) {
    const std::uint64_t sample = first + i;
    const auto four = normals(words(seed_, stream_hash_, trial_, sample / 4));
    for (std::size_t lane = sample % 4; lane < 4 && i < out.size(); ++lane) out[i++] = four[lane];
  }
}

double NormalStream::uniform(std::uint64_t sample) const {
  return to_unit(words(seed_, stream_hash_, trial_, sample / 4)[sample % 4]);
}

}  // namespace gyrostat
