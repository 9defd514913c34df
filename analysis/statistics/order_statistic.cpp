#include <gyrostat/analysis/statistics/order_statistic.hpp>

#include <algorithm>
#include <bit>

namespace gyrostat {
namespace {

constexpr std::size_t bin_count = 4096;
constexpr std::size_t most_kept = 16384;
constexpr std::uint64_t sign = 1ULL << 63;

/// Keys are ordered as the numbers are.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits & sign ? ~bits : bits | sign;
}

double number_of(std::uint64_t key) {
  return std::bit_cast<double>(key & sign ? key & ~sign : ~key);
}

}  // namespace

void OrderStatistic::add(double value) {
  const auto key = key_of(value);
  if (first_pass_) ++count_;
  if (key < low_) return;
  if (key > high_) {
    least_above_ = std::min(least_above_, key);
    return;
  }
  if (!keeps_) {
    ++bins_[(key - low_) >> shift_];
    return;
  }
  kept_.push_back(key);
  if (kept_.size() > most_kept) to_bins();
}

void OrderStatistic::to_bins() {
  keeps_ = false;
  bins_.assign(bin_count, 0);
  for (const auto key : kept_) ++bins_[(key - low_) >> shift_];
  kept_.clear();
}

bool OrderStatistic::another_pass(std::size_t rank) {
  first_pass_ = false;
  if (keeps_) {
    settle(rank);
    return false;
  }
  if (low_ == high_) {  // one number, more often than may be kept
    value_ = number_of(low_);
    next_ = rank + 1 < below_ + inside_ || least_above_ == ~0ULL ? value_ : number_of(least_above_);
    return false;
  }
  narrow(rank);
  return true;
}

void OrderStatistic::settle(std::size_t rank) {
  std::sort(kept_.begin(), kept_.end());
  const auto at = rank - below_;
  value_ = number_of(kept_[at]);
  next_ = at + 1 < kept_.size()   ? number_of(kept_[at + 1])
          : least_above_ == ~0ULL ? value_
                                  : number_of(least_above_);
}

void OrderStatistic::narrow(std::size_t rank) {
  std::size_t bin = 0;
  while (below_ + bins_[bin] <= rank) below_ += bins_[bin++];
  inside_ = bins_[bin];
  low_ += static_cast<std::uint64_t>(bin) << shift_;
  high_ = low_ + ((1ULL << shift_) - 1);
  shift_ = std::max(0, shift_ - 12);
  least_above_ = ~0ULL;
  keeps_ = inside_ <= most_kept;
  if (!keeps_) bins_.assign(bin_count, 0);
}

}  // namespace gyrostat
