#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <gyrostat/analysis/sensitivity/designs.hpp>
#include <gyrostat/core/values.hpp>

namespace gyrostat {

/// One product of a polynomial chaos: the degree that it has in each parameter, and its factor in
/// the output's unit.
struct ChaosTerm {
  std::vector<std::uint8_t> degrees;
  double coefficient = 0.0;
};

/// What of a chaos is the parameter's at a point, or on average over the cube.
struct ChaosParts {
  std::vector<double> alone;   ///< terms of this parameter and no other
  std::vector<double> in_all;  ///< terms that have it at all
};

/// A sum of products of orthonormal polynomials of a unit cube's coordinates: those of Legendre
/// where the coordinate is uniform on [0, 1], those of Gram (discrete Chebyshev) where it stands
/// for `levels` equally likely values. Both obey x p_n = b_(n+1) p_(n+1) + b_n p_(n-1) in
/// x = 2u - 1, from the middle of the level, with b_n = n / sqrt(4 n^2 - 1) sqrt(1 - n^2 /
/// levels^2) (Gautschi, Orthogonal Polynomials, 2004, table 1.1 and example 1.15).
struct Chaos {
  std::vector<std::size_t> levels{};  ///< by parameter; 0: the coordinate is continuous
  std::vector<ChaosTerm> terms{};     ///< the constant first
  /// Mean squared error of a point left out, as a share of the points' variance.
  double left_out_error = no_value;

  double operator()(std::span<const double> point) const;
  double mean() const { return terms.front().coefficient; }
  double variance() const;  ///< over the cube
  ChaosParts variances() const;
  ChaosParts parts(std::span<const double> point) const;
};

/// How large a chaos may become: products with (sum of degrees^q)^(1/q), q = 0.75, up to `bound`,
/// and `terms` of these.
struct ChaosSize {
  int bound = 1;
  std::size_t terms = 1;
};

/// A sparse chaos of values at points, by orthogonal matching pursuit: the product that is most
/// correlated with what is left joins, and all coefficients are those of least squares. Its error
/// of a point left out is corrected for the number of products (Blatman and Sudret, J. Comput.
/// Phys. 230, 2011, eq. 27). No value (NaN) leaves its point out.
Chaos fit_chaos(const Points& points, std::span<const double> values,
                const std::vector<std::size_t>& levels, const ChaosSize& size);

/// The chaos of all points, and for each part of the points that of the others.
struct CrossedChaos {
  Chaos of_all;
  std::vector<Chaos> of_others;  ///< by part
};

/// All of one size, that of the least squared error at the points left out: products are chosen
/// anew for each part, since of many products those that fit the noise are always found. The bound
/// grows while that error falls. `part_of` by point, from 0.
CrossedChaos fit_chaoses(const Points& points, std::span<const double> values,
                         const std::vector<std::size_t>& levels,
                         const std::vector<std::size_t>& part_of);

}  // namespace gyrostat
