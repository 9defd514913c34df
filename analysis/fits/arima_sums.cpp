#include <gyrostat/analysis/fits/arima_sums.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/jet.h>

#include <gyrostat/analysis/fits/arima_innovations.hpp>
#include <gyrostat/analysis/fits/settled/kernels.hpp>

namespace gyrostat {
namespace {

using Jet = ceres::Jet<double, 4>;
using Products = Eigen::Matrix<double, 5, 5>;

constexpr std::size_t lanes = SettledModels::lanes;

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

/// Over samples none of which is missing, where all of them keep their gains: their states move on.
/// The sums of squares of their innovations.
std::array<double, lanes> advance(std::span<const double> z,
                                  std::span<ArimaInnovations<double>> models) {
  SettledModels at{};
  for (std::size_t m = 0; m < models.size(); ++m) {
    at.x[m] = models[m].x;
    at.e[m] = models[m].e;
    at.phi[m] = models[m].phi;
    at.gain_x[m] = models[m].gain_x;
    at.gain_e[m] = models[m].gain_e;
  }
  settled_kernel().models(z, at);
  for (std::size_t m = 0; m < models.size(); ++m) {
    models[m].x = at.x[m];
    models[m].e = at.e[m];
  }
  return std::to_array(at.squares);
}

/// Of at most `lanes` models.
std::vector<ArimaSums> sums_together(std::span<const Arima111<double>> models,
                                     std::span<const double> rate) {
  const std::size_t N = models.size();
  std::vector<ArimaSums> sums(N);
  double first = 0.0;
  const auto z = after_first(rate, first);
  std::vector<ArimaInnovations<double>> at;
  for (const auto& model : models) at.emplace_back(model, first);
  for (std::size_t k = 0; k < z.size();) {
    // Each alone until its gain is kept, then to where the last of them is.
    std::size_t together = k;
    std::array<std::size_t, lanes> reached{};
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
    const auto squares = advance(z.subspan(k, end - k), at);
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

Eigen::Map<Eigen::Vector4d> vector(double (&of)[4]) { return Eigen::Map<Eigen::Vector4d>(of); }

SettledDerivatives settled_at(const ArimaInnovations<Jet>& model) {
  SettledDerivatives at{};
  at.x = model.x.a;
  at.e = model.e.a;
  at.phi = model.phi.a;
  at.gain_x = model.gain_x.a;
  at.gain_e = model.gain_e.a;
  vector(at.d_x) = model.x.v;
  vector(at.d_e) = model.e.v;
  vector(at.d_phi) = model.phi.v;
  vector(at.d_gain_x) = model.gain_x.v;
  vector(at.d_gain_e) = model.gain_e.v;
  return at;
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

/// A recursion whose gain is kept from here on.
struct Settling {
  ArimaInnovations<Jet>* model;
  ArimaDerivatives* sums;
  std::size_t from;
};

/// As `advance`, with the derivatives: each alone to where the last of them has settled, then
/// together up to `end`.
void advance(std::span<const double> z, std::size_t end, std::span<const Settling> settled) {
  std::size_t together = 0;
  for (const auto& one : settled) together = std::max(together, one.from);
  std::vector<SettledDerivatives> at;
  for (const auto& one : settled) {
    at.push_back(settled_at(*one.model));
    settled_kernel().derivatives(z.subspan(one.from, together - one.from), {&at.back(), 1});
  }
  if (!at.empty()) settled_kernel().derivatives(z.subspan(together, end - together), at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    auto& model = *settled[i].model;
    model.x.a = at[i].x;
    model.x.v = vector(at[i].d_x);
    model.e.a = at[i].e;
    model.e.v = vector(at[i].d_e);
    Products products;  // of (d nu, nu)
    products << Eigen::Map<Eigen::Matrix4d>(at[i].products[0]), vector(at[i].mixed),
        vector(at[i].mixed).transpose(), at[i].squares;
    add(*settled[i].sums, products, model.variance, static_cast<double>(end - settled[i].from));
  }
}

}  // namespace

ArimaSums arima_sums(const Arima111<double>& arima, std::span<const double> rate_dps) {
  return sums_together({&arima, 1}, rate_dps).front();
}

std::vector<ArimaSums> arima_sums(std::span<const Arima111<double>> models,
                                  std::span<const double> rate_dps) {
  std::vector<ArimaSums> sums;
  for (std::size_t m = 0; m < models.size(); m += lanes) {
    const auto found =
        sums_together(models.subspan(m, std::min(lanes, models.size() - m)), rate_dps);
    sums.insert(sums.end(), found.begin(), found.end());
  }
  return sums;
}

ArimaDerivatives arima_derivatives(const Arima111<double>& arima,
                                   std::span<const double> rate_dps) {
  return arima_derivatives({&arima, 1}, rate_dps).front();
}

std::vector<ArimaDerivatives> arima_derivatives(std::span<const Arima111<double>> models,
                                                std::span<const double> rate_dps) {
  std::vector<ArimaDerivatives> sums(models.size());
  double first = 0.0;
  const auto z = after_first(rate_dps, first);
  std::vector<ArimaInnovations<Jet>> at;
  for (const auto& [phi, delta1, delta2, noise] : models)
    at.push_back({{Jet(phi, 0), Jet(delta1, 1), Jet(delta2, 2), Jet(noise, 3)}, first});
  for (std::size_t k = 0; k < z.size(); ++k) {
    const std::size_t end = next_missing(z, k);
    std::vector<Settling> settled;
    for (std::size_t m = 0; m < at.size(); ++m) {
      std::size_t reached = k;
      for (; reached < end && !at[m].settled; ++reached)
        if (at[m].step(z[reached])) add(sums[m], at[m].innovation, at[m].variance);
      if (reached < end) settled.push_back({&at[m], &sums[m], reached});
    }
    advance(z, end, settled);
    if (end < z.size())
      for (auto& model : at) model.step(z[end]);
    k = end;
  }
  return sums;
}

}  // namespace gyrostat
