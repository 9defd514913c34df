// Sums of an even sequence, against their definition.

#include <gyrostat/analysis/spectra/cosine_sums.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace gyrostat::cosine_sums_test {
namespace {

TEST(CosineSums, AreThoseOfTheDefinitionAndTheirOwnInverse) {
  for (const std::size_t n : {1, 2, 8, 64}) {
    const auto size = static_cast<double>(n);
    std::vector<double> x;
    for (std::size_t h = 0; h <= n; ++h) x.push_back(std::sin(1.7 * static_cast<double>(h)) + 0.3);
    const auto y = cosine_sums(x);
    ASSERT_EQ(y.size(), n + 1);
    for (std::size_t k = 0; k <= n; ++k) {
      double sum = x[0] + (k % 2 == 0 ? x[n] : -x[n]);
      for (std::size_t h = 1; h < n; ++h)
        sum += 2.0 * x[h] * std::cos(std::numbers::pi * static_cast<double>(k * h) / size);
      EXPECT_NEAR(y[k], sum, 1e-12 * (size + 1.0)) << n << ' ' << k;
    }
    const auto back = cosine_sums(y);
    for (std::size_t h = 0; h <= n; ++h)
      EXPECT_NEAR(back[h], 2.0 * size * x[h], 1e-12 * (size * size + 1.0)) << n << ' ' << h;
  }
}

}  // namespace
}  // namespace gyrostat::cosine_sums_test
