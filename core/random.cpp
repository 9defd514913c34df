#include <gyrostat/core/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Random123/philox.h>

#include <gyrostat/core/packed/kernels.hpp>
#include <gyrostat/core/packed/normals.hpp>

namespace gyrostat {
namespace {

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3U;
  return hash;
}

r123::Philox4x32::ctr_type words(std::uint64_t seed, std::uint64_t stream_hash, std::uint32_t trial,
                                 std::uint64_t block) {
  const r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(block), trial,
                                               static_cast<std::uint32_t>(stream_hash),
                                               static_cast<std::uint32_t>(stream_hash >> 32U)}};
  const r123::Philox4x32::key_type key = {
      {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)}};
  return r123::Philox4x32{}(counter, key);
}

double to_unit(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

NormalAddress address(std::uint64_t seed, std::uint64_t stream_hash, std::uint32_t trial) {
  const auto low = [](std::uint64_t v) { return static_cast<std::uint32_t>(v); };
  return {{low(seed), low(seed >> 32U)}, trial, {low(stream_hash), low(stream_hash >> 32U)}};
}

/// Where no more is known of the processor than what the whole program is compiled for.
struct Baseline;

}  // namespace

NormalAddress address_of(std::uint64_t seed, std::string_view stream) {
  return address(seed, fnv1a(stream), 0);
}

NormalStream::NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream)
    : seed_(seed), stream_hash_(fnv1a(stream)), trial_(trial) {}

NormalStream::NormalStream(std::uint64_t seed, std::uint32_t trial, std::string_view stream,
                           std::span<const NoiseShare> shares, std::vector<double>* tape,
                           std::span<const double> shift)
    : seed_(seed),
      stream_hash_(fnv1a(stream)),
      trial_(trial),
      shares_(shares),
      shift_(shift),
      tape_(tape) {}

double NormalStream::normal(std::uint64_t sample) const {
  double sum = sample < shift_.size() ? shift_[sample] : 0.0;
  for (const auto& share : shares_) sum += share.weight * normal_of(share.trial, sample);
  const double value = shares_.empty() ? normal_of(trial_, sample) : sum;
  if (tape_ != nullptr) {
    if (tape_->size() <= sample) tape_->resize(sample + 1);
    (*tape_)[sample] = value;
  }
  return value;
}

void NormalStream::fill(std::uint64_t first, std::span<double> out) const {
  if (shares_.empty()) {
    fill_of(trial_, first, out);
  } else {
    std::array<double, 256> piece{};
    for (std::size_t at = 0; at < out.size(); at += piece.size()) {
      const auto part = out.subspan(at, std::min(piece.size(), out.size() - at));
      const auto drawn = std::span(piece).first(part.size());
      for (std::size_t i = 0; i < part.size(); ++i)
        part[i] = first + at + i < shift_.size() ? shift_[first + at + i] : 0.0;
      for (const auto& share : shares_) {
        fill_of(share.trial, first + at, drawn);
        for (std::size_t i = 0; i < part.size(); ++i) part[i] += share.weight * drawn[i];
      }
    }
  }
  if (tape_ == nullptr) return;
  if (tape_->size() < first + out.size()) tape_->resize(first + out.size());
  std::copy(out.begin(), out.end(), tape_->begin() + static_cast<std::ptrdiff_t>(first));
}

double NormalStream::normal_of(std::uint32_t trial, std::uint64_t sample) const {
  std::array<double, 4> four{};
  NormalBlocks<Baseline, 1>::normals(address(seed_, stream_hash_, trial),
                                     static_cast<std::uint32_t>(sample / 4), four.data());
  return four[sample % 4];
}

void NormalStream::fill_of(std::uint32_t trial, std::uint64_t first, std::span<double> out) const {
  constexpr std::size_t chunk = 4 * normal_blocks;
  const auto normals = available_kernels().back()->normals;
  const NormalAddress at = address(seed_, stream_hash_, trial);
  for (std::size_t i = 0; i < out.size();) {
    const std::uint64_t sample = first + i;
    const auto block = static_cast<std::uint32_t>(sample / 4);
    const std::size_t skipped = sample % 4;
    if (skipped == 0 && out.size() - i >= chunk) {
      normals(at, block, &out[i]);
      i += chunk;
      continue;
    }
    std::array<double, chunk> some{};
    normals(at, block, some.data());
    for (std::size_t j = skipped; j < chunk && i < out.size(); ++j) out[i++] = some[j];
  }
}

double NormalStream::uniform(std::uint64_t sample) const {
  if (!shares_.empty())
    return std::clamp(0.5 * std::erfc(-normal(sample) / std::numbers::sqrt2),
                      std::numeric_limits<double>::min(), 1.0 - 0x1p-53);
  return to_unit(words(seed_, stream_hash_, trial_, sample / 4)[sample % 4]);
}

}  // namespace gyrostat
