#include <gyrostat/analysis/sensitivity/surrogate.hpp>

#include <algorithm>

#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/sensitivity/paired_trials.hpp>
#include <gyrostat/analysis/sensitivity/trial_moments.hpp>

namespace gyrostat {
namespace {

constexpr std::size_t most_parts = 10;

/// Outputs by their distance from the trial's mean over all points, and back to the mean's level.
struct Centred {
  Outputs outputs;
  std::vector<double> means;  ///< over trials, by point
  double level = 0.0;         ///< that all trials have on average
};

Centred centred(const Outputs& outputs) {
  Centred c{outputs, std::vector<double>(outputs.points(), no_value)};
  const auto levels = trial_levels(outputs);
  double trials = 0.0;
  for (const double level : levels)
    if (!std::isnan(level)) {
      c.level += level;
      trials += 1.0;
    }
  c.level /= trials;
  for (std::size_t i = 0; i < outputs.points(); ++i) {
    double sum = 0.0, count = 0.0;
    for (std::size_t t = 0; t < outputs.trials(); ++t) {
      const double d = c.outputs.at(i, t) -= levels[t];
      if (std::isnan(d)) continue;
      sum += d;
      count += 1.0;
    }
    c.means[i] = sum / count;
  }
  return c;
}

/// What the chaos of the other rows leaves of a row.
class Residuals {
 public:
  Residuals(const Points& points, const std::vector<std::size_t>& levels, const Centred& data,
            std::size_t in_row)
      : in_row_(in_row),
        residuals_(data.outputs),
        parts_(std::min(most_parts, points.size() / in_row)) {
    std::vector<std::size_t> parts;
    for (std::size_t i = 0; i < points.size(); ++i) parts.push_back(part_of(i));
    chaoses_ = fit_chaoses(points, data.means, levels, parts);
    for (const auto& chaos : chaoses_.of_others) {
      variances_.push_back(chaos.variance());
      of_parameters_.push_back(chaos.variances());
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& chaos = chaoses_.of_others[part_of(i)];
      const double value = chaos(points[i]);
      centred_values_.push_back(value - chaos.mean());
      at_.push_back(chaos.parts(points[i]));
      for (std::size_t t = 0; t < residuals_.trials(); ++t) residuals_.at(i, t) -= value;
    }
  }

  const Chaos& of_all() const { return chaoses_.of_all; }
  const Outputs& outputs() const { return residuals_; }
  std::size_t rows() const { return residuals_.points() / in_row_; }
  double variance(std::size_t point) const { return variances_[part_of(point)]; }
  double centred_value(std::size_t point) const { return centred_values_[point]; }
  const ChaosParts& variances(std::size_t point) const { return of_parameters_[part_of(point)]; }
  const ChaosParts& at(std::size_t point) const { return at_[point]; }

 private:
  std::size_t part_of(std::size_t point) const { return point / in_row_ % parts_; }

  std::size_t in_row_;
  Outputs residuals_;
  std::size_t parts_;
  CrossedChaos chaoses_{};
  std::vector<double> variances_{}, centred_values_{};
  std::vector<ChaosParts> of_parameters_{}, at_{};
};

/// A row's numbers, with all trials and with each left out.
using Numbers = std::vector<std::vector<double>>;

/// Sums over a row's points that an index is made of.
struct RowSums {
  std::vector<double> means;                       ///< of r
  std::vector<double> with;                        ///< of r times the whole chaos
  std::vector<double> squares;                     ///< of r^2, of different trials
  std::vector<double> noise;                       ///< variance of a point's mean
  std::vector<std::vector<double>> alone, in_all;  ///< by parameter, of r times its terms
};

class RowReader {
 public:
  RowReader(const Residuals& residuals, std::size_t parameters)
      : r_(residuals), parameters_(parameters), variants_(residuals.outputs().trials() + 1) {}

  /// Means over those points of the row that have enough trials; false where one has not.
  bool read(std::size_t row, RowSums& sums) const {
    const std::size_t in_row = parameters_ + 2, first = row * in_row;
    const std::vector<double> none(variants_, 0.0);
    sums = {none, none, none, none, {parameters_, none}, {parameters_, none}};
    std::vector<double> trials(variants_ - 1);
    for (std::size_t i = first; i < first + in_row; ++i) {
      if (!are_enough(common_trials(r_.outputs(), {i}), r_.outputs())) return false;
      for (std::size_t t = 0; t < trials.size(); ++t) trials[t] = r_.outputs().at(i, t);
      const auto means = trial_means(trials);
      const double share = 1.0 / static_cast<double>(in_row);
      for (std::size_t v = 0; v < variants_; ++v) {
        const double mean = share * means[v].mean;
        sums.means[v] += mean;
        sums.with[v] += mean * r_.centred_value(i);
        sums.squares[v] += share * means[v].square();
        sums.noise[v] += share * means[v].variance;
        for (std::size_t p = 0; p < parameters_; ++p) {
          sums.alone[p][v] += mean * r_.at(i).alone[p];
          sums.in_all[p][v] += mean * r_.at(i).in_all[p];
        }
      }
    }
    return true;
  }

  /// Of the mean over trials at two points: r(a) r(b) and (r(a) - r(b))^2 / 2, of different trials.
  /// False where too few trials have both.
  bool compare(std::size_t a, std::size_t b, std::vector<double>& products,
               std::vector<double>& differences) const {
    const auto common = common_trials(r_.outputs(), {a, b});
    if (!are_enough(common, r_.outputs())) return false;
    std::vector<double> first(variants_ - 1, no_value), second = first, difference = first;
    for (const auto t : common) {
      first[t] = r_.outputs().at(a, t);
      second[t] = r_.outputs().at(b, t);
      difference[t] = first[t] - second[t];
    }
    const auto firsts = trial_means(first), seconds = trial_means(second),
               both = trial_means(difference);
    products.resize(variants_);
    differences.resize(variants_);
    for (std::size_t v = 0; v < variants_; ++v) {
      differences[v] = 0.5 * both[v].square();
      products[v] = 0.5 * (firsts[v].square() + seconds[v].square()) - differences[v];
    }
    return true;
  }

  /// The variance's part of a row: without (E r)^2, which is a mean's square.
  double variance(std::size_t row, const RowSums& sums, std::size_t v) const {
    return r_.variance(row * (parameters_ + 2)) + 2.0 * sums.with[v] + sums.squares[v];
  }

  std::size_t variants() const { return variants_; }

 private:
  const Residuals& r_;
  std::size_t parameters_, variants_;
};

/// Of means (a quantity, the variance with (E r)^2, E r): the quantity as a share of the variance;
/// (E r)^2 is in it, too, where it is that of a parameter alone.
double share(std::span<const double> m, bool has_mean) {
  const double square = m[2] * m[2], variance = m[1] - square;
  return variance > 0.0 ? (m[0] - (has_mean ? square : 0.0)) / variance : no_value;
}
double plain_share(std::span<const double> m) { return share(m, false); }
double share_of_one(std::span<const double> m) { return share(m, true); }

/// By half of what is unexplained either way.
void widen(Estimate& e, double unexplained) {
  const double half = 0.5 * std::max(0.0, unexplained);
  e.low -= half;
  e.high += half;
}

}  // namespace

Surrogate surrogate_of(const Points& points, const std::vector<std::size_t>& levels,
                       const Outputs& outputs, Resampler& resampler) {
  const std::size_t parameters = levels.size(), in_row = parameters + 2;
  const auto data = centred(outputs);
  const Residuals residuals(points, levels, data, in_row);
  Surrogate surrogate{.chaos = residuals.of_all(),
                      .indices = sobol_indices(parameters, outputs, resampler)};
  surrogate.chaos.terms.front().coefficient += data.level;
  const RowReader reader(residuals, parameters);
  const std::size_t trials = outputs.trials();
  CrossedRows unexplained(3, trials), noise(3, trials);
  std::vector<CrossedRows> alone(parameters, unexplained), in_all = alone;
  std::vector<std::size_t> left_out(parameters, 0);
  RowSums sums;
  std::vector<double> products, differences, unused;
  for (std::size_t row = 0; row < residuals.rows(); ++row) {
    const std::size_t a = row * in_row, b = a + 1;
    if (!reader.read(row, sums)) {
      for (auto& n : left_out) ++n;
      continue;
    }
    const auto add = [&](CrossedRows& rows, const auto& quantity) {
      Numbers numbers;
      for (std::size_t v = 0; v < reader.variants(); ++v)
        numbers.push_back({quantity(v), reader.variance(row, sums, v), sums.means[v]});
      rows.add(numbers);
    };
    add(unexplained, [&](std::size_t v) { return sums.squares[v]; });
    add(noise, [&](std::size_t v) { return sums.noise[v]; });
    for (std::size_t p = 0; p < parameters; ++p) {
      const bool whole = reader.compare(b, a + 2 + p, products, unused) &&
                         reader.compare(a, a + 2 + p, unused, differences);
      left_out[p] += !whole;
      if (!whole) continue;
      const auto& exact = residuals.variances(a);
      add(alone[p],
          [&](std::size_t v) { return exact.alone[p] + 2.0 * sums.alone[p][v] + products[v]; });
      add(in_all[p], [&](std::size_t v) {
        return exact.in_all[p] + 2.0 * sums.in_all[p][v] + differences[v];
      });
    }
  }
  surrogate.unexplained = bootstrapped(unexplained, plain_share, resampler);
  surrogate.is_trusted = surrogate.unexplained.value < Surrogate::most_unexplained &&
                         !(surrogate.unexplained.high >= Surrogate::most_unexplained);
  if (!surrogate.is_trusted) return surrogate;
  for (std::size_t p = 0; p < parameters; ++p) {
    auto& index = surrogate.indices[p];
    index.first_order = bootstrapped(alone[p], share_of_one, resampler);
    index.total = bootstrapped(in_all[p], plain_share, resampler);
    index.left_out = left_out[p];
    widen(index.first_order, surrogate.unexplained.value);
    widen(index.total, surrogate.unexplained.value);
  }
  surrogate.indices.back().first_order = bootstrapped(noise, plain_share, resampler);
  return surrogate;
}

}  // namespace gyrostat
