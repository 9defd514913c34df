#include <gyrostat/diagnosis/compare/segmented_sides.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

#include <gyrostat/core/error.hpp>
#include <gyrostat/diagnosis/lens_band.hpp>
#include <gyrostat/diagnosis/thresholds.hpp>

namespace gyrostat::gap {
namespace {

Eigen::MatrixXd readings_of(const SegmentReader& reader,
                            const std::vector<std::vector<double>>& segments) {
  Eigen::MatrixXd all(reader.instrument().size(), static_cast<Eigen::Index>(segments.size()));
  tbb::parallel_for(std::size_t{0}, segments.size(), [&](std::size_t k) {
    all.col(static_cast<Eigen::Index>(k)) = reader.read(segments[k]);
  });
  return all;
}

std::vector<double> louder_by(double share, std::vector<double> segment) {
  const double mean =
      std::accumulate(segment.begin(), segment.end(), 0.0) / static_cast<double>(segment.size());
  for (double& value : segment) value = mean + (1.0 + share) * (value - mean);
  return segment;
}

std::vector<double> mean_of(const Eigen::MatrixXd& readings, const LensView& lens) {
  const Eigen::VectorXd mean = readings.middleRows(lens.first, lens.count).rowwise().mean();
  return {mean.begin(), mean.end()};
}

std::vector<double> spread_of(const Eigen::MatrixXd& readings, const LensView& lens) {
  const auto rows = readings.middleRows(lens.first, lens.count);
  const Eigen::VectorXd mean = rows.rowwise().mean();
  const Eigen::VectorXd spread = ((rows.colwise() - mean).rowwise().squaredNorm() /
                                  std::max<double>(1.0, static_cast<double>(rows.cols() - 1)))
                                     .cwiseSqrt();
  return {spread.begin(), spread.end()};
}

}  // namespace

SegmentedSides::SegmentedSides(const StudiedSide& real, const StudiedSide& simulated,
                               const Matched& matched, std::uint64_t seed)
    : real_side_(real),
      simulated_side_(simulated),
      seed_(seed),
      resolution_dps_(std::max(real.resolution_dps(), simulated.resolution_dps())),
      whole_(matched.rate_hz, matched.segment),
      piece_(matched.rate_hz, matched.piece) {
  real_ = readings_of(whole_, segments(real_side_, Part::train, whole_.samples(), {}));
  simulated_ = train({});
  const auto real_pieces =
      readings_of(piece_, segments(real_side_, Part::held_out, piece_.samples(), {}));
  const auto simulated_pieces = held_out({});
  constexpr Eigen::Index fewest = 3;
  if (std::min({real_.cols(), simulated_.cols(), real_pieces.cols(), simulated_pieces.cols()}) <
      fewest)
    throw InputError((real_.cols() < fewest ? real_side_ : simulated_side_).name,
                     "too many samples are missing to cut it into segments");
  gap_ = std::make_unique<SegmentGap>(piece_.instrument(), real_pieces, simulated_pieces);
}

Series SegmentedSides::mended(std::size_t trace, const Addition& addition) const {
  return simulated_side_.traces[trace]->mended(addition,
                                               {seed_, static_cast<std::uint32_t>(trace)});
}

SegmentedSides::Segments SegmentedSides::segments(const StudiedSide& side, Part part,
                                                  std::size_t samples,
                                                  const Addition& addition) const {
  Segments all;
  for (std::size_t k = 0; k < side.traces.size(); ++k) {
    const auto& trace = *side.traces[k];
    const auto error = trace.error_dps(
        addition.is_nothing() ? trace.series().gyro_dps : mended(k, addition).gyro_dps,
        resolution_dps_);
    for (auto& segment : segments_of(trace.conditions(), error, part, samples))
      all.push_back(std::move(segment));
  }
  return all;
}

Eigen::MatrixXd SegmentedSides::train(const Addition& addition) const {
  return readings_of(whole_, segments(simulated_side_, Part::train, whole_.samples(), addition));
}

Eigen::MatrixXd SegmentedSides::held_out(const Addition& addition) const {
  return readings_of(piece_, segments(simulated_side_, Part::held_out, piece_.samples(), addition));
}

TwoSamples SegmentedSides::test(const Addition& addition) const {
  return two_samples(whole_.instrument(), real_,
                     addition.is_nothing() ? simulated_ : train(addition), seed_);
}

std::vector<Where> SegmentedSides::departures(const TwoSamples& test) const {
  std::vector<Where> found;
  for (const auto& lens : whole_.instrument().lenses())
    for (Eigen::Index i = lens.first; i < lens.first + lens.count; ++i) {
      if (test.p_adjusted[i] > thresholds::departure) continue;
      const auto& at = whole_.instrument().at()[static_cast<std::size_t>(i)];
      found.push_back({std::string(lens.id), std::string(lens.channel),
                       std::string(lens.coordinate), std::string(lens.unit), at.from, at.to,
                       test.real[i], test.simulated[i], test.p_adjusted[i]});
    }
  return found;
}

std::vector<Band> SegmentedSides::bands(const Addition& addition) const {
  const auto after = addition.is_nothing() ? simulated_ : train(addition);
  std::vector<Band> all;
  for (const auto& lens : whole_.instrument().lenses()) {
    auto band = band_of(whole_.instrument(), lens);
    band.observed = mean_of(real_, lens);
    band.before = mean_of(simulated_, lens);
    band.before_spread = spread_of(simulated_, lens);
    band.after = mean_of(after, lens);
    band.after_spread = spread_of(after, lens);
    all.push_back(std::move(band));
  }
  return all;
}

std::vector<Power> SegmentedSides::power(double level) const {
  auto all = segments(real_side_, Part::train, whole_.samples(), {});
  for (auto& segment : segments(simulated_side_, Part::train, whole_.samples(), {}))
    all.push_back(std::move(segment));
  Eigen::MatrixXd plain(real_.rows(), real_.cols() + simulated_.cols());
  plain << real_, simulated_;
  std::vector<Power> powers;
  for (const double louder : {0.02, 0.05, 0.1, 0.2, 0.5}) {
    Segments scaled;
    for (const auto& segment : all) scaled.push_back(louder_by(louder, segment));
    powers.push_back(
        {louder, power_of_two_samples(whole_.instrument(), plain, readings_of(whole_, scaled),
                                      real_.cols(), level, seed_)});
  }
  return powers;
}

double SegmentedSides::gap(const Addition& addition) const { return (*gap_)(held_out(addition)); }

std::array<double, 2> SegmentedSides::closed(const Addition& addition) const {
  return gap_->closed(held_out(addition), seed_);
}

}  // namespace gyrostat::gap
