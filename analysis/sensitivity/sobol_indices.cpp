#include <gyrostat/analysis/sensitivity/estimators.hpp>
#include <gyrostat/analysis/sensitivity/paired_trials.hpp>
#include <gyrostat/analysis/sensitivity/trial_moments.hpp>

namespace gyrostat {
namespace {

/// Two points of each row, held against each other.
class Comparison {
 public:
  explicit Comparison(const Outputs& outputs)
      : outputs_(outputs),
        levels_(trial_levels(outputs)),
        squares_(2, outputs.trials()),
        noises_(2, outputs.trials()) {}

  /// Half the squared difference, half the squares, and the noise in these, of points `a` and `b`.
  /// False where too few trials have both.
  bool add(std::size_t a, std::size_t b) {
    const auto common = common_trials(outputs_, {a, b});
    if (!are_enough(common, outputs_)) return false;
    std::vector<double> first(outputs_.trials(), no_value), second = first, difference = first;
    for (const auto t : common) {
      first[t] = outputs_.at(a, t) - levels_[t];
      second[t] = outputs_.at(b, t) - levels_[t];
      difference[t] = first[t] - second[t];
    }
    const auto firsts = trial_means(first), seconds = trial_means(second),
               differences = trial_means(difference);
    std::vector<std::vector<double>> squares, noises;
    for (std::size_t i = 0; i < firsts.size(); ++i) {
      const double both = 0.5 * (firsts[i].square() + seconds[i].square());
      squares.push_back({0.5 * differences[i].square(), both});
      noises.push_back({0.5 * (firsts[i].variance + seconds[i].variance), both});
    }
    squares_.add(squares);
    noises_.add(noises);
    return true;
  }

  /// What the two points share of their variance, what they do not, and the noise as a share of it.
  Estimate shared(Resampler& resampler) const {
    return bootstrapped(
        squares_, [](auto m) { return 1.0 - share(m); }, resampler);
  }
  Estimate unshared(Resampler& resampler) const { return bootstrapped(squares_, share, resampler); }
  Estimate noise(Resampler& resampler) const { return bootstrapped(noises_, share, resampler); }

 private:
  static double share(std::span<const double> means) {
    return means[1] > 0.0 ? means[0] / means[1] : no_value;
  }

  const Outputs& outputs_;
  std::vector<double> levels_;
  CrossedRows squares_, noises_;
};

}  // namespace

std::vector<SobolIndex> sobol_indices(std::size_t parameters, const Outputs& outputs,
                                      Resampler& resampler) {
  std::vector<SobolIndex> indices;
  const std::size_t points = parameters + 2, rows = outputs.points() / points;
  for (std::size_t p = 0; p < parameters; ++p) {
    SobolIndex index;
    Comparison from_b(outputs), from_a(outputs);
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t a = r * points, b = a + 1, mixed = a + 2 + p;
      const bool whole = from_b.add(b, mixed);
      index.left_out += !(from_a.add(a, mixed) && whole);
    }
    index.first_order = from_b.shared(resampler);
    index.total = from_a.unshared(resampler);
    indices.push_back(index);
  }
  Comparison both(outputs);
  SobolIndex noise;
  for (std::size_t r = 0; r < rows; ++r) noise.left_out += !both.add(r * points, r * points + 1);
  noise.first_order = both.noise(resampler);
  indices.push_back(noise);
  return indices;
}

}  // namespace gyrostat
