#include <gyrostat/analysis/fits/arima_sums.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/jet.h>

#include <gyrostat/analysis/fits/arima_innovations.hpp>

namespace gyrostat {
namespace {

using Jet = ceres::Jet<double, 4>;
using Products = Eigen::Matrix<double, 5, 5>;

/// Models that advance together: a recursion waits for itself, several fill the wait.
constexpr std::size_t lanes = 8;

std::span<const double> after_first(std::span<const double> z, double& first) {
  std::size_t k = 0;
  while (k < z.size() && is_missing(z[k])) ++k;
  if (k == z.size()) return {};
  first = z[k];
  return z.subspan(k + 1);
}

std::size_t next_missing(std::span<const double> z, std::size_t from) {
  while (from < z.size() && !is_missing(z[from])) ++from;
  return from;
}

/// Of recursions whose gains are kept, over samples none of which is missing: their states move on,
/// and the squares of their innovations are added to `squares`.
template <std::size_t N>
void advance(std::span<const double> z, std::array<ArimaInnovations<double>*, N> models,
             std::array<double, N>& squares) {
  std::array<double, N> x{}, e{}, phi{}, gain_x{}, gain_e{}, sum{};
  for (std::size_t m = 0; m < N; ++m) {
    x[m] = models[m]->x;
    e[m] = models[m]->e;
    phi[m] = models[m]->phi;
    gain_x[m] = models[m]->gain_x;
    gain_e[m] = models[m]->gain_e;
  }
  for (const double sample : z)
    for (std::size_t m = 0; m < N; ++m) {
      const double predicted = x[m] + e[m];
      const double innovation = sample - predicted;
      x[m] = predicted + gain_x[m] * innovation;
      e[m] = e[m] * phi[m] + gain_e[m] * innovation;
      sum[m] += innovation * innovation;
    }
  for (std::size_t m = 0; m < N; ++m) {
    models[m]->x = x[m];
    models[m]->e = e[m];
    squares[m] = sum[m];
  }
}

template <std::size_t N>
std::array<ArimaSums, N> sums_of(const std::array<Arima111<double>, N>& models,
                                 std::span<const double> rate) {
  std::array<ArimaSums, N> sums{};
  double first = 0.0;
  const auto z = after_first(rate, first);
  std::vector<ArimaInnovations<double>> at;
  std::array<ArimaInnovations<double>*, N> settled;
  for (std::size_t m = 0; m < N; ++m) at.emplace_back(models[m], first);
  for (std::size_t m = 0; m < N; ++m) settled[m] = &at[m];
  for (std::size_t k = 0; k < z.size();) {
    // Each alone until its gain is kept, then to where the last of them is.
    std::size_t together = k;
    std::array<std::size_t, N> reached{};
    const auto step = [&](std::size_t m) {
      if (!at[m].step(z[reached[m]++])) return;
      sums[m].squares += at[m].innovation * at[m].innovation / at[m].variance;
      sums[m].logs += std::log(at[m].variance);
      sums[m].count += 1.0;
    };
    for (std::size_t m = 0; m < N; ++m) {
      reached[m] = k;
      do step(m);
      while (reached[m] < z.size() && !at[m].settled);
      together = std::max(together, reached[m]);
    }
    for (std::size_t m = 0; m < N; ++m)
      while (reached[m] < together) step(m);
    const bool all =
        std::all_of(at.begin(), at.end(), [](const auto& model) { return model.settled; });
    k = together;
    if (!all) continue;
    const std::size_t end = next_missing(z, k);
    std::array<double, N> squares{};
    advance<N>(z.subspan(k, end - k), settled, squares);
    for (std::size_t m = 0; m < N; ++m) {
      const auto count = static_cast<double>(end - k);
      sums[m].squares += squares[m] / at[m].variance;
      sums[m].logs += count * std::log(at[m].variance);
      sums[m].count += count;
    }
    k = end;
  }
  return sums;
}

/// As `advance`, with the derivatives: sum of products of (d nu, nu).
Products advance(std::span<const double> z, ArimaInnovations<Jet>& model) {
  double x = model.x.a, e = model.e.a, squares = 0.0;
  Eigen::Vector4d dx = model.x.v, de = model.e.v, mixed = Eigen::Vector4d::Zero();
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  const double phi = model.phi.a, gain_x = model.gain_x.a, gain_e = model.gain_e.a;
  const Eigen::Vector4d d_phi = model.phi.v, d_gain_x = model.gain_x.v, d_gain_e = model.gain_e.v;
  for (const double sample : z) {
    x += e;
    dx += de;
    de = phi * de + e * d_phi;
    const double nu = sample - x;
    squares += nu * nu;
    mixed -= nu * dx;
    products.noalias() += dx * dx.transpose();
    de += nu * d_gain_e - gain_e * dx;
    dx += nu * d_gain_x - gain_x * dx;
    x += gain_x * nu;
    e = phi * e + gain_e * nu;
  }
  model.x.a = x;
  model.x.v = dx;
  model.e.a = e;
  model.e.v = de;
  Products all;
  all << products, mixed, mixed.transpose(), squares;
  return all;
}

/// Adds one term.
void add(ArimaDerivatives& to, const Jet& innovation, const Jet& variance) {
  const double S = variance.a, inverse = 1.0 / S, root = std::sqrt(inverse);
  const Eigen::Vector4d relative = inverse * variance.v;
  Eigen::Matrix<double, 5, 1> term;
  term << root * (innovation.v - 0.5 * innovation.a * relative), root * innovation.a;
  to.products.noalias() += term * term.transpose();
  to.information.noalias() +=
      inverse * innovation.v * innovation.v.transpose() + 0.5 * relative * relative.transpose();
  to.logs += relative;
  to.sums.squares += innovation.a * innovation.a * inverse;
  to.sums.logs += std::log(S);
  to.sums.count += 1.0;
}

/// Adds terms of one variance, given their sum of products of (d nu, nu).
void add(ArimaDerivatives& to, const Products& products, const Jet& variance, double count) {
  const double S = variance.a;
  const Eigen::Vector4d relative = variance.v / S;
  Products whiten = Products::Identity();
  whiten.topRightCorner<4, 1>() = -0.5 * relative;
  to.products.noalias() += whiten * products * whiten.transpose() / S;
  to.information.noalias() +=
      products.topLeftCorner<4, 4>() / S + 0.5 * count * relative * relative.transpose();
  to.logs += count * relative;
  to.sums.squares += products(4, 4) / S;
  to.sums.logs += count * std::log(S);
  to.sums.count += count;
}

}  // namespace

ArimaSums arima_sums(const Arima111<double>& arima, std::span<const double> rate_dps) {
  return sums_of<1>({arima}, rate_dps)[0];
}

std::vector<ArimaSums> arima_sums(std::span<const Arima111<double>> models,
                                  std::span<const double> rate_dps) {
  std::vector<ArimaSums> sums;
  for (std::size_t m = 0; m < models.size(); m += lanes) {
    const std::size_t filled = std::min(lanes, models.size() - m);
    std::array<Arima111<double>, lanes> group;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      group[lane] = models[m + std::min(lane, filled - 1)];
    const auto found = sums_of<lanes>(group, rate_dps);
    sums.insert(sums.end(), found.begin(), found.begin() + filled);
  }
  return sums;
}

ArimaDerivatives arima_derivatives(const Arima111<double>& arima,
                                   std::span<const double> rate_dps) {
  ArimaDerivatives sums;
  double first = 0.0;
  const auto z = after_first(rate_dps, first);
  ArimaInnovations<Jet> at({Jet(arima.phi, 0), Jet(arima.delta1_dps, 1), Jet(arima.delta2_dps, 2),
                            Jet(arima.measurement_noise_std_dps, 3)},
                           first);
  for (std::size_t k = 0; k < z.size();) {
    if (at.settled && !is_missing(z[k])) {
      const std::size_t end = next_missing(z, k);
      const Products products = advance(z.subspan(k, end - k), at);
      add(sums, products, at.variance, static_cast<double>(end - k));
      k = end;
    } else if (at.step(z[k++])) {
      add(sums, at.innovation, at.variance);
    }
  }
  return sums;
}

}  // namespace gyrostat
