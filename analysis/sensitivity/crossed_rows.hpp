#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/analysis/sensitivity/indices.hpp>

namespace gyrostat {

/// Rows of a design, each reduced over its trials to the same few numbers; and the same with each
/// trial left out, since rows share their trials and so their noise.
class CrossedRows {
 public:
  CrossedRows(std::size_t components, std::size_t trials)
      : components_(components), trials_(trials) {}

  /// `numbers[0]` are the row's components, `numbers[1 + t]` those without trial t.
  void add(const std::vector<std::vector<double>>& numbers);

  std::size_t rows() const { return values_.size() / components_; }
  std::size_t components() const { return components_; }
  std::size_t trials() const { return trials_; }
  std::span<const double> row(std::size_t r) const {
    return {&values_[r * components_], components_};
  }
  std::span<const double> without(std::size_t r, std::size_t t) const {
    return {&without_[(r * trials_ + t) * components_], components_};
  }

 private:
  std::size_t components_, trials_;
  std::vector<double> values_, without_;
};

/// A statistic of design rows: a smooth function of the means of their components.
using OfMeans = std::function<double(std::span<const double> means)>;

/// How often each row, and each trial, stands in each resample; the same in every run.
class Resampler {
 public:
  static constexpr std::size_t resamples = 999;

  Resampler(std::uint64_t seed, std::string stream) : seed_(seed), stream_(std::move(stream)) {}
  /// Counts of `items` drawn with replacement, resample after resample.
  std::span<const std::uint16_t> counts(std::size_t items, const std::string& kind);

 private:
  std::uint64_t seed_;
  std::string stream_;
  std::map<std::pair<std::string, std::size_t>, std::vector<std::uint16_t>> drawn_;
};

/// The statistic with its 95 % interval by the bootstrap-t (Efron and Tibshirani, An Introduction
/// to the Bootstrap, 1993, ch. 12): rows are resampled, and trials with them as far as they have an
/// effect that all rows share. Its variance is that of rows plus that of trials minus that of their
/// cells, which both contain (Cameron, Gelbach and Miller, J. Bus. Econ. Stat. 29, 2011). No
/// interval with fewer than four rows, or where more than one resample in twenty has no value.
Estimate bootstrapped(const CrossedRows& rows, const OfMeans& statistic, Resampler& resampler);

}  // namespace gyrostat
