#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace gyrostat {

/// Where a block of four deviates stands: the Philox key and the counter without the block's
/// number.
struct NormalAddress {
  std::uint32_t key[2];
  std::uint32_t trial;
  std::uint32_t stream[2];
};

/// `Blocks` successive blocks of four normal deviates, in loops that the compiler turns into
/// instructions of `Target` (in the name so that code of different instruction sets has different
/// names). Additions, multiplications, divisions and square roots of doubles in a fixed order, so
/// every target and every number of blocks gives the same bits.
template <class Target, int Blocks>
class NormalBlocks {
 public:
  /// The words of blocks first, first + 1, ...: word j of block i at words[j][i].
  [[gnu::always_inline]] static void philox(const NormalAddress& at, std::uint32_t first,
                                            std::uint32_t (&words)[4][Blocks]) {
    for (int i = 0; i < Blocks; ++i) {
      words[0][i] = first + static_cast<std::uint32_t>(i);
      words[1][i] = at.trial;
      words[2][i] = at.stream[0];
      words[3][i] = at.stream[1];
    }
    philox(at, words);
  }

  /// The words whose counters stand in `words`: Philox4x32-10 (Salmon et al., "Parallel random
  /// numbers: as easy as 1, 2, 3", SC11).
  [[gnu::always_inline]] static void philox(const NormalAddress& at,
                                            std::uint32_t (&words)[4][Blocks]) {
    std::uint32_t key0 = at.key[0], key1 = at.key[1];
    for (int round = 0; round < 10; ++round) {
      for (int i = 0; i < Blocks; ++i) {
        const std::uint64_t a = std::uint64_t{words[0][i]} * 0xD2511F53U;
        const std::uint64_t b = std::uint64_t{words[2][i]} * 0xCD9E8D57U;
        words[0][i] = static_cast<std::uint32_t>(b >> 32U) ^ words[1][i] ^ key0;
        words[1][i] = static_cast<std::uint32_t>(b);
        words[2][i] = static_cast<std::uint32_t>(a >> 32U) ^ words[3][i] ^ key1;
        words[3][i] = static_cast<std::uint32_t>(a);
      }
      key0 += 0x9E3779B9U;
      key1 += 0xBB67AE85U;
    }
  }

  /// `normals` as one function.
  [[gnu::flatten]] static void fill(const NormalAddress& at, std::uint32_t first, double* out) {
    normals(at, first, out);
  }

  [[gnu::always_inline]] static void normals(const NormalAddress& at, std::uint32_t first,
                                             double* out) {
    std::uint32_t words[4][Blocks];
    philox(at, first, words);
    double made[4][Blocks];
    transform(words, made);
    for (int i = 0; i < Blocks; ++i)
      for (int j = 0; j < 4; ++j) out[4 * i + j] = made[j][i];
  }

  /// Those of blocks first, first + 1, ... of `Lanes` trials side by side: deviate k of lane l is
  /// at out[k * Lanes + l], without being moved there from elsewhere.
  template <int Lanes>
  [[gnu::always_inline]] static void side_by_side(const NormalAddress& at,
                                                  const std::uint32_t* trials, std::uint32_t first,
                                                  double* out) {
    static_assert(Blocks % Lanes == 0);
    std::uint32_t words[4][Blocks];
    for (int i = 0; i < Blocks; ++i) {
      words[0][i] = first + static_cast<std::uint32_t>(i / Lanes);
      words[1][i] = trials[i % Lanes];
      words[2][i] = at.stream[0];
      words[3][i] = at.stream[1];
    }
    philox(at, words);
    double made[4][Blocks];
    transform(words, made);
    for (int b = 0; b < Blocks / Lanes; ++b)
      for (int j = 0; j < 4; ++j)
        for (int l = 0; l < Lanes; ++l) out[(4 * b + j) * Lanes + l] = made[j][b * Lanes + l];
  }

  /// Box and Muller (1958): of each pair of words a radius and an angle.
  [[gnu::always_inline]] static void transform(const std::uint32_t (&words)[4][Blocks],
                                               double (&made)[4][Blocks]) {
    for (int pair = 0; pair < 4; pair += 2)
      for (int i = 0; i < Blocks; ++i) {
        const double r = radius(words[pair][i]);
        const Turn turn = turned(words[pair + 1][i]);
        made[pair][i] = r * turn.cosine;
        made[pair + 1][i] = r * turn.sine;
      }
  }

 private:
  static double as_double(std::uint64_t bits) { return std::bit_cast<double>(bits); }
  static double from_signed(std::uint32_t word) {
    return static_cast<double>(static_cast<std::int32_t>(word));
  }

  /// sqrt(-2 log u), u = (word + 1/2) / 2^32. log u = k log 2 + log m with m in [sqrt 1/2, sqrt 2),
  /// by the series in s = (m - 1) / (m + 1) of fdlibm's e_log.c (Sun Microsystems 1993), below one
  /// unit in the last place.
  [[gnu::always_inline]] static double radius(std::uint32_t word) {
    const double u = (from_signed(word ^ 0x80000000U) + 2147483648.5) * 0x1p-32;
    constexpr std::uint64_t root_half = 0x3fe6a09eULL << 32U, one = 0x3ff00000ULL << 32U;
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(u) + (one - root_half);
    const double k = as_double((bits >> 52U) | 0x4330000000000000ULL) - (0x1p52 + 1023.0);
    const double f = as_double((bits & 0x000fffffffffffffULL) + root_half) - 1.0;
    const double s = f / (2.0 + f), z = s * s, w = z * z, half_square = 0.5 * f * f;
    const double even = w * (3.999999999940941908e-01 +
                             w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
    const double odd = z * (6.666666666666735130e-01 +
                            w * (2.857142874366239149e-01 +
                                 w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
    const double log =
        (s * (half_square + (odd + even)) + k * 1.90821492927058770002e-10 - half_square + f) +
        k * 6.93147180369123816490e-01;
    return std::sqrt(-2.0 * log);
  }

  struct Turn {
    double cosine, sine;
  };

  /// cos and sin of 2 pi u, u = (word + 1/2) / 2^32: the quadrant and what is left of it, within an
  /// eighth of a turn, are exact; then the polynomials of fdlibm's k_sin.c and k_cos.c, below one
  /// unit in the last place.
  [[gnu::always_inline]] static Turn turned(std::uint32_t word) {
    const std::uint32_t shifted = word + (1U << 29U);
    const std::uint64_t quadrant = shifted >> 30U;
    const double rest = from_signed((shifted & 0x3fffffffU) - (1U << 29U)) + 0.5;
    const double x = rest * (0x1p-30 * 1.57079632679489661923), z = x * x;
    const double s =
        x +
        x * z *
            (-1.66666666666666324348e-01 +
             z * (8.33333333332248946124e-03 +
                  z * (-1.98412698298579493134e-04 +
                       z * (2.75573137070700676789e-06 +
                            z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
    const double tail =
        z * (4.16666666666666019037e-02 +
             z * (-1.38888888888741095749e-03 +
                  z * (2.48015872894767294178e-05 +
                       z * (-2.75573143513906633035e-07 +
                            z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const double half = 0.5 * z, w = 1.0 - half;
    const double c = w + ((1.0 - w - half) + z * tail);
    // In quadrants 1 and 3 cosine and sine change places; the signs follow the quadrant.
    const std::uint64_t swap = -(quadrant & 1U), bits_c = std::bit_cast<std::uint64_t>(c),
                        bits_s = std::bit_cast<std::uint64_t>(s), differ = (bits_c ^ bits_s) & swap;
    return {as_double(bits_c ^ differ ^ (((quadrant + 1U) & 2U) << 62U)),
            as_double(bits_s ^ differ ^ ((quadrant & 2U) << 62U))};
  }
};

}  // namespace gyrostat
