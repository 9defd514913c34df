#include <gyrostat/diagnosis/compare/two_samples.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gyrostat/core/random.hpp>

namespace gyrostat::gap {
namespace {

constexpr int relabellings = 1999;

/// Least spreads of readings: that of their lens, and rounding.
Eigen::VectorXd floors(const Instrument& instrument) {
  Eigen::VectorXd least = Eigen::VectorXd::Constant(instrument.size(), 1e-9);
  for (const auto& lens : instrument.lenses())
    least.segment(lens.first, lens.count).array() += 0.1 * lens.least_spread;
  return least;
}

Eigen::VectorXd weights(const Instrument& instrument) {
  Eigen::VectorXd weight(instrument.size());
  for (const auto& lens : instrument.lenses())
    weight.segment(lens.first, lens.count)
        .setConstant(1.0 / std::sqrt(static_cast<double>(lens.count)));
  return weight;
}

/// Squared t values of every reading, the first `real` of `order` being one group.
Eigen::VectorXd squared_t(const Eigen::MatrixXd& all, const std::vector<Eigen::Index>& order,
                          Eigen::Index real, const Eigen::VectorXd& least) {
  const auto n = static_cast<Eigen::Index>(order.size());
  Eigen::VectorXd sum[2] = {Eigen::VectorXd::Zero(all.rows()), Eigen::VectorXd::Zero(all.rows())};
  Eigen::VectorXd square = Eigen::VectorXd::Zero(all.rows());
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto column = all.col(order[static_cast<std::size_t>(k)]);
    sum[k < real ? 0 : 1] += column;
    square += column.cwiseAbs2();
  }
  const auto a = static_cast<double>(real), b = static_cast<double>(n - real);
  const Eigen::ArrayXd within = (square - sum[0].cwiseAbs2() / a - sum[1].cwiseAbs2() / b).array();
  const Eigen::ArrayXd variance =
      within.max(0.0) / std::max(1.0, a + b - 2.0) + least.array().square();
  return ((sum[0] / a - sum[1] / b).array().square() / (variance * (1.0 / a + 1.0 / b))).matrix();
}

/// About the common mean, so that sums of squares lose nothing.
Eigen::MatrixXd centred(const Eigen::MatrixXd& all) { return all.colwise() - all.rowwise().mean(); }

class Shuffler {
 public:
  Shuffler(std::uint64_t seed, std::string_view what) : stream_(seed, 0, what) {}

  void operator()(std::vector<Eigen::Index>& order) {
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[below(k)]);
  }
  std::size_t below(std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(stream_.uniform(at_++) * static_cast<double>(count)));
  }

 private:
  NormalStream stream_;
  std::uint64_t at_ = 0;
};

std::vector<Eigen::Index> in_order(Eigen::Index count) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  return order;
}

}  // namespace

TwoSamples two_samples(const Instrument& instrument, const Eigen::MatrixXd& real,
                       const Eigen::MatrixXd& simulated, std::uint64_t seed) {
  Eigen::MatrixXd all(real.rows(), real.cols() + simulated.cols());
  all << real, simulated;
  const auto values = centred(all);
  const auto least = floors(instrument), weight = weights(instrument);
  auto order = in_order(all.cols());
  const auto seen = squared_t(values, order, real.cols(), least);
  const double statistic = seen.dot(weight);
  Shuffler shuffle(seed, "two_samples");
  double reached = 1.0;
  Eigen::ArrayXd beyond = Eigen::ArrayXd::Ones(seen.size());
  for (int k = 0; k < relabellings; ++k) {
    shuffle(order);
    const auto t = squared_t(values, order, real.cols(), least);
    if (t.dot(weight) >= statistic * (1.0 - 1e-12)) reached += 1.0;
    beyond += (seen.array() <= t.maxCoeff() * (1.0 + 1e-12)).cast<double>();
  }
  return {.p = reached / (relabellings + 1.0),
          .p_adjusted = (beyond / (relabellings + 1.0)).matrix(),
          .real = real.rowwise().mean(),
          .simulated = simulated.rowwise().mean()};
}

double power_of_two_samples(const Instrument& instrument, const Eigen::MatrixXd& plain,
                            const Eigen::MatrixXd& louder, Eigen::Index real, double level,
                            std::uint64_t seed) {
  constexpr int groups = 100, each = 199;
  const auto least = floors(instrument), weight = weights(instrument);
  const Eigen::VectorXd centre = plain.rowwise().mean();
  Shuffler shuffle(seed, "power_of_two_samples");
  auto drawn = in_order(plain.cols());
  int found = 0;
  for (int g = 0; g < groups; ++g) {
    shuffle(drawn);
    Eigen::MatrixXd values(plain.rows(), plain.cols());
    for (Eigen::Index k = 0; k < plain.cols(); ++k)
      values.col(k) = (k < real ? louder : plain).col(drawn[static_cast<std::size_t>(k)]) - centre;
    auto order = in_order(plain.cols());
    const double statistic = squared_t(values, order, real, least).dot(weight);
    double reached = 1.0;
    for (int k = 0; k < each; ++k) {
      shuffle(order);
      if (squared_t(values, order, real, least).dot(weight) >= statistic * (1.0 - 1e-12))
        reached += 1.0;
    }
    if (reached / (each + 1.0) <= level) ++found;
  }
  return static_cast<double>(found) / groups;
}

SegmentGap::SegmentGap(const Instrument& instrument, const Eigen::MatrixXd& real,
                       const Eigen::MatrixXd& simulated)
    : real_(real), before_(simulated), weight_(weights(instrument).cwiseAbs2()) {
  const auto deviations = [](const Eigen::MatrixXd& of) {
    return Eigen::VectorXd((of.colwise() - of.rowwise().mean()).rowwise().squaredNorm() /
                           std::max(1.0, static_cast<double>(of.cols()) - 1.0));
  };
  spread_ = (0.5 * (deviations(real) + deviations(simulated)) + floors(instrument).cwiseAbs2())
                .cwiseSqrt();
  weight_ /= weight_.sum();
}

double SegmentGap::of(const Eigen::MatrixXd& real, const Eigen::MatrixXd& simulated) const {
  constexpr double most = 10.0;
  const Eigen::ArrayXd z2 =
      (real.rowwise().mean() - simulated.rowwise().mean()).cwiseQuotient(spread_).array().square();
  const double chance =
      1.0 / static_cast<double>(real.cols()) + 1.0 / static_cast<double>(simulated.cols());
  return std::sqrt(std::max(0.0, weight_.dot((z2 / (1.0 + z2 / (most * most))).matrix()) - chance));
}

double SegmentGap::operator()(const Eigen::MatrixXd& simulated) const {
  return of(real_, simulated);
}

std::array<double, 2> SegmentGap::closed(const Eigen::MatrixXd& after, std::uint64_t seed) const {
  constexpr int draws = 400;
  Shuffler draw(seed, "segment_gap");
  std::vector<double> values;
  const auto again = [&](const Eigen::MatrixXd& of, const std::vector<Eigen::Index>& which) {
    Eigen::MatrixXd chosen(of.rows(), of.cols());
    for (Eigen::Index k = 0; k < of.cols(); ++k)
      chosen.col(k) = of.col(which[static_cast<std::size_t>(k)]);
    return chosen;
  };
  const auto drawn = [&](Eigen::Index count) {
    std::vector<Eigen::Index> which;
    for (Eigen::Index k = 0; k < count; ++k)
      which.push_back(static_cast<Eigen::Index>(draw.below(static_cast<std::size_t>(count))));
    return which;
  };
  for (int k = 0; k < draws; ++k) {
    const auto real = again(real_, drawn(real_.cols()));
    const auto which = drawn(before_.cols());
    const double from = of(real, again(before_, which));
    values.push_back(from > 0.0 ? 1.0 - of(real, again(after, which)) / from : 0.0);
  }
  std::sort(values.begin(), values.end());
  return {values[draws / 40], values[draws - 1 - draws / 40]};
}

}  // namespace gyrostat::gap
