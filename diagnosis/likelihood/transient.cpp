#include <gyrostat/diagnosis/likelihood/transient.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include <unsupported/Eigen/FFT>

#include <gyrostat/core/step.hpp>
#include <gyrostat/diagnosis/likelihood/hidden_line.hpp>

namespace gyrostat::gap {
namespace {

constexpr std::size_t per_length = 4;  // blocks begin
constexpr std::size_t shortest = 32, blocks_for_a_mean = 25;
constexpr double longest_s = 4.0;
constexpr Eigen::Index lowest_tile = 4;  // bin, above what a level that walks leaves
constexpr std::size_t fewest_rows = 8;

/// Periodograms of blocks of one length, dps².
struct Tiles {
  std::size_t length;
  std::vector<std::size_t> begins{};  ///< of blocks, a sample each
  Eigen::ArrayXXd powers{};           ///< bins x blocks
};

Tiles tiles_of(const Conditions& conditions, Part part, const std::vector<double>& left_dps,
               std::size_t length) {
  Tiles tiles{.length = length};
  std::vector<double> taper(length);
  for (std::size_t i = 0; i < length; ++i)
    taper[i] = 1.0 - std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) /
                              static_cast<double>(length));
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> values(length), powers;
  std::vector<std::complex<double>> transform;
  for (const auto& span : conditions.spans(part))
    for (std::size_t at = span.first; at + length <= span.last; at += length / per_length) {
      double weight = 0.0;
      for (std::size_t i = 0; i < length; ++i) {
        const bool is_there = !is_missing(left_dps[at + i]);
        values[i] = is_there ? taper[i] * left_dps[at + i] : 0.0;
        weight += is_there ? taper[i] * taper[i] : 0.0;
      }
      if (weight < 0.75 * static_cast<double>(length)) continue;  // half of what all would have
      fft.fwd(transform, values);
      tiles.begins.push_back(at);
      for (std::size_t k = 0; k < length / 2; ++k)
        powers.push_back(std::norm(transform[k]) / weight);
    }
  tiles.powers =
      Eigen::Map<const Eigen::ArrayXXd>(powers.data(), static_cast<Eigen::Index>(length / 2),
                                        static_cast<Eigen::Index>(tiles.begins.size()));
  return tiles;
}

/// By their size in units of what is usual about them, which of the tiles is the largest.
struct LargestTile {
  Eigen::Index row = 0, block = 0;
  double size = 0.0;
};

/// Blocks on either side that tell what is usual, beyond those that a block overlaps with.
constexpr Eigen::Index told_by = 8, overlapped = per_length - 1;
/// Bins whose lower quartile is known to a third of it.
constexpr Eigen::Index enough_bins = 48;

/// Of powers over the mean of their bins: what those about a block have and, where there are enough
/// bins, its own weaker ones, if that is more.
double usual_at(Eigen::Index block, const Eigen::ArrayXXd& over, const Eigen::ArrayXd& means) {
  double sum = 0.0, count = 0.0;
  for (Eigen::Index other = std::max<Eigen::Index>(0, block - told_by);
       other < std::min(over.cols(), block + told_by + 1); ++other)
    if (std::abs(other - block) > overlapped) {
      sum += means[other];
      count += 1.0;
    }
  if (over.rows() < enough_bins) return sum / count;
  std::vector<double> own(over.col(block).begin(), over.col(block).end());
  const auto quartile = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 4);
  std::nth_element(own.begin(), quartile, own.end());
  const double quartile_of_exponentials = std::log(4.0 / 3.0);
  return std::max(sum / count, *quartile / quartile_of_exponentials);
}

/// What all bins of a block, those of lines as well, may leave in one of them: of what begins in
/// its middle 4 / (pi d)^2 is d bins further.
double leaking_into(Eigen::Index bin, const Eigen::ArrayXXd::ConstColXpr& block) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < block.size(); ++j)
    if (const auto d = static_cast<double>(j - bin); std::abs(d) > 2.0)
      sum += 4.0 * block[j] / std::pow(std::numbers::pi * d, 2);
  return sum;
}

/// Of those rows alone.
LargestTile largest_of(const Eigen::ArrayXXd& all, const std::vector<Eigen::Index>& rows) {
  const Eigen::ArrayXXd powers = all(rows, Eigen::all);
  const auto n = static_cast<double>(powers.cols());
  const Eigen::ArrayXd sums = powers.rowwise().sum();
  const Eigen::ArrayXXd over = powers.colwise() * (n / sums);
  const Eigen::ArrayXd means = over.colwise().mean().transpose();
  LargestTile largest;
  for (Eigen::Index b = 0; b < powers.cols(); ++b) {
    const double usual = usual_at(b, over, means);
    for (Eigen::Index k = 0; k < powers.rows(); ++k) {
      const double without = (sums[k] - powers(k, b)) / (n - 1.0);
      if (powers(k, b) <= largest.size * without * usual) continue;
      const auto row = rows[static_cast<std::size_t>(k)];
      const double size = powers(k, b) / std::max(without * usual, leaking_into(row, all.col(b)));
      if (size > largest.size) largest = {row, b, size};
    }
  }
  return largest;
}

/// Of nine tenths of the values: a knock is in few of them.
double usual_extent(std::vector<double> values) {
  std::erase_if(values, [](double value) { return is_missing(value); });
  if (values.empty()) return 0.0;
  const auto at = [&](std::size_t twentieths) {
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(twentieths * (values.size() - 1) / 20);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  return at(19) - at(1);
}

/// Neither turned nor tilted, as far as anything beside the gyro shows.
bool is_at_rest(const Conditions& conditions) {
  constexpr double most_mps2 = 0.5, most_dps = 5.0;
  const auto& series = conditions.series();
  const auto changes = [&](const std::vector<double>& channel) {
    return channel.empty() ? 0.0 : usual_extent(conditions.slow_means(channel));
  };
  return series.rate_ref_dps.empty() && changes(series.acc_x_mps2) < most_mps2 &&
         changes(series.acc_y_mps2) < most_mps2 && changes(series.acc_z_mps2) < most_mps2 &&
         changes(series.cross_rate_1_dps) < most_dps && changes(series.cross_rate_2_dps) < most_dps;
}

}  // namespace

std::optional<Transient> clearest_transient(const Conditions& conditions, Part part,
                                            const std::vector<double>& left_dps,
                                            const std::vector<Resonance>& lines) {
  if (!is_at_rest(conditions)) return std::nullopt;
  std::optional<Transient> clearest;
  double tried = 0.0;
  const double rate_hz = conditions.rate_hz();
  for (std::size_t length = shortest; static_cast<double>(length) <= longest_s * rate_hz;
       length *= 2) {
    const auto tiles = tiles_of(conditions, part, left_dps, length);
    if (tiles.begins.size() < blocks_for_a_mean * per_length) break;
    const double resolution_hz = rate_hz / static_cast<double>(length);
    const auto frequency_of = [&](Eigen::Index k) {
      return resolution_hz * static_cast<double>(k);
    };
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = lowest_tile; k < tiles.powers.rows(); ++k) {
      const Resonance tile{0.0, frequency_of(k), 2.0 * resolution_hz};
      if (std::none_of(lines.begin(), lines.end(),
                       [&](const auto& line) { return are_neighbours(line, tile); }))
        rows.push_back(k);
    }
    if (rows.size() < fewest_rows) continue;
    const auto& powers = tiles.powers;
    const auto [row, block, size] = largest_of(powers, rows);
    const auto blocks = static_cast<double>(powers.cols()), bins = static_cast<double>(rows.size());
    tried += blocks * bins;
    // An exponential over two means of exponentials. Of bins a taper leaves every other its own,
    // and of blocks that begin a half apart each.
    constexpr double own = 0.5 * per_length;
    const double about = 0.5 * bins * 2.0 * static_cast<double>(told_by - overlapped) / own;
    const double degrees = 1.0 / (1.0 / about + own / blocks);
    const double p = std::pow(1.0 + size / degrees, -degrees);
    if (clearest && p >= clearest->p_value) continue;
    const double usual = (powers.row(row).sum() - powers(row, block)) / (blocks - 1.0);
    const auto begin = static_cast<double>(tiles.begins[static_cast<std::size_t>(block)]);
    clearest = Transient{.from_s = begin * conditions.interval_s(),
                         .to_s = (begin + static_cast<double>(length)) * conditions.interval_s(),
                         .frequency_hz = frequency_of(row),
                         .rms_dps = std::sqrt(std::max(0.0, 3.0 * (powers(row, block) - usual) /
                                                                static_cast<double>(length))),
                         .p_value = p};
  }
  if (clearest) clearest->p_value = std::min(1.0, tried * clearest->p_value);
  return clearest;
}

}  // namespace gyrostat::gap
