#pragma once

#include <gyrostat/core/numerics/cholesky.hpp>
#include <gyrostat/core/numerics/linear.hpp>

namespace gyrostat {

/// Root of the time update of three states of which the first becomes the combination `first` of
/// all three plus noise of variance `drive` + `excess`, the second the old first, and the third
/// stays: the lower triangle of the rows (u, w), (l00, 0, 0, 0), (l20, l21, l22, 0) with u =
/// first^T L and w^2 the noise, by one rotation of columns 1, 2 and the noise's and one of columns
/// 0 and 1. No difference of squares is taken, so nothing is lost near a singular covariance. A row
/// without a remainder leaves its column to the next, as in `lower_root`.
///
/// `drive` comes from noise that is a state of its own beside these three; `excess` may be negative
/// (sigma points with a negative central weight). Where the covariance of the three and the noise
/// is then not positive definite, false, and `root` is of no use.
template <class T>
[[nodiscard]] Mask<T> companion_root(Matrix<T, 3>& root, const Vector<T, 3>& first, const T& drive,
                                     const T& excess) {
  using std::sqrt;
  const auto positive_root = [](const T& v) { return select(v > T(0.0), T(sqrt(v)), T(0.0)); };
  const T l00 = root(0, 0), l20 = root(2, 0), l21 = root(2, 1), l22 = root(2, 2);
  const T u0 = first(0) * l00 + first(1) * root(1, 0) + first(2) * l20;
  const T u1 = first(1) * root(1, 1) + first(2) * l21;
  const T u2 = first(2) * l22;

  const T noise = drive + excess, linear = u1 * u1 + u2 * u2;
  const T turned = linear + noise, whole = u0 * u0 + turned;
  const T along = l21 * u1 + l22 * u2, across = l21 * u2 - l22 * u1, tail = l21 * l21 + l22 * l22;
  const T squared = across * across, rest = squared + noise * tail;
  const Mask<T> turns = turned > T(0.0), remains = whole > T(0.0);

  const T w = positive_root(turned), norm = positive_root(whole);
  const T per_w = select(turns, T(T(1.0) / w), T(1.0)), per_norm = T(1.0) / norm;
  const T c = select(remains, T(u0 * per_norm), T(0.0)),
          s = select(remains, T(w * per_norm), T(1.0));
  const T shared = along * per_w;
  root(0, 0) = norm;
  root(1, 0) = c * l00;
  root(1, 1) = s * l00;
  root(2, 0) = c * l20 + s * shared;
  root(2, 1) = s * l20 - c * shared;
  root(2, 2) = positive_root(select(turns, rest, tail)) * per_w;
  return excess >= T(0.0) || (linear + excess > T(0.0) && squared + excess * tail > T(0.0));
}

}  // namespace gyrostat
