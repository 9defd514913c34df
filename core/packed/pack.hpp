#pragma once

#include <Eigen/Core>
#include <experimental/simd>

#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/numerics/linear.hpp>
#include <gyrostat/core/step.hpp>

namespace gyrostat {

/// `N` doubles side by side, each the same variable of another trial, in registers of the
/// instruction set `Target`. More lanes than a register holds are several registers, whose chains
/// of dependent operations run interleaved. Operations are IEEE's, lane by lane, so a lane has the
/// bits that a double would have.
///
/// `Target` is in the type so that code compiled for different instruction sets has different
/// names.
template <class Target, int N>
class Pack {
  static constexpr int width = N < Target::width ? N : Target::width;
  static constexpr int registers = N / width;
  using Register =
      std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, width>>;
  using Bits = typename Register::mask_type;

 public:
  static constexpr int lanes = N;
  static_assert(N % width == 0);

  /// Of a comparison: true or false for each lane.
  class LaneMask {
   public:
    LaneMask() = default;
    LaneMask(bool value) {  // NOLINT
      unrolled<registers>([&]<int r>() { bits_[r] = Bits(value); });
    }
    bool operator[](int lane) const { return bits_[lane / width][lane % width]; }

    friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) {
      return each([&]<int r>() { return a.bits_[r] && b.bits_[r]; });
    }
    friend LaneMask operator||(const LaneMask& a, const LaneMask& b) {
      return each([&]<int r>() { return a.bits_[r] || b.bits_[r]; });
    }
    friend LaneMask operator!(const LaneMask& a) {
      return each([&]<int r>() { return !a.bits_[r]; });
    }
    friend bool any(const LaneMask& a) {
      Bits found = a.bits_[0];
      unrolled<registers - 1>([&]<int r>() { found = found || a.bits_[r + 1]; });
      return std::experimental::any_of(found);
    }
    friend bool all(const LaneMask& a) { return !any(!a); }

    const Bits& bits(int r) const { return bits_[r]; }
    template <class Of>
    [[gnu::always_inline]] static LaneMask each(const Of& of) {
      LaneMask out;
      unrolled<registers>([&]<int r>() { out.bits_[r] = of.template operator()<r>(); });
      return out;
    }

   private:
    Bits bits_[registers];
  };

  Pack() = default;
  Pack(double value) {  // NOLINT
    unrolled<registers>([&]<int r>() { registers_[r] = value; });
  }
  /// The `N` values from `from` on.
  static Pack load(const double* from) {
    return each(
        [&]<int r>() { return Register(from + r * width, std::experimental::element_aligned); });
  }
  void store(double* to) const {
    unrolled<registers>([&]<int r>() {
      registers_[r].copy_to(to + r * width, std::experimental::element_aligned);
    });
  }
  double operator[](int lane) const { return registers_[lane / width][lane % width]; }

  friend Pack operator+(const Pack& a, const Pack& b) {
    return each([&]<int r>() { return a.registers_[r] + b.registers_[r]; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return each([&]<int r>() { return a.registers_[r] - b.registers_[r]; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return each([&]<int r>() { return a.registers_[r] * b.registers_[r]; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return each([&]<int r>() { return a.registers_[r] / b.registers_[r]; });
  }
  friend Pack operator-(const Pack& a) {
    return each([&]<int r>() { return -a.registers_[r]; });
  }
  Pack& operator+=(const Pack& b) { return *this = *this + b; }
  Pack& operator-=(const Pack& b) { return *this = *this - b; }
  Pack& operator*=(const Pack& b) { return *this = *this * b; }
  Pack& operator/=(const Pack& b) { return *this = *this / b; }

  friend LaneMask operator<(const Pack& a, const Pack& b) {
    return LaneMask::each([&]<int r>() { return a.registers_[r] < b.registers_[r]; });
  }
  friend LaneMask operator>(const Pack& a, const Pack& b) { return b < a; }
  friend LaneMask operator<=(const Pack& a, const Pack& b) {
    return LaneMask::each([&]<int r>() { return a.registers_[r] <= b.registers_[r]; });
  }
  friend LaneMask operator>=(const Pack& a, const Pack& b) { return b <= a; }
  friend LaneMask operator==(const Pack& a, const Pack& b) {
    return LaneMask::each([&]<int r>() { return a.registers_[r] == b.registers_[r]; });
  }
  friend LaneMask operator!=(const Pack& a, const Pack& b) { return !(a == b); }

  friend Pack select(const LaneMask& mask, const Pack& yes, const Pack& no) {
    return each([&]<int r>() {
      Register out = no.registers_[r];
      where(mask.bits(r), out) = yes.registers_[r];
      return out;
    });
  }
  friend Pack sqrt(const Pack& a) {
    return each([&]<int r>() { return std::experimental::sqrt(a.registers_[r]); });
  }
  friend LaneMask isnan(const Pack& a) { return a != a; }
  friend LaneMask isfinite(const Pack& a) { return a - a == Pack(0.0); }

 private:
  template <class Of>
  [[gnu::always_inline]] static Pack each(const Of& of) {
    Pack out;
    unrolled<registers>([&]<int r>() { out.registers_[r] = of.template operator()<r>(); });
    return out;
  }
  Register registers_[registers];
};

template <class Target, int N>
struct MaskOf<Pack<Target, N>> {
  using type = typename Pack<Target, N>::LaneMask;
};

}  // namespace gyrostat

template <class Target, int N>
struct Eigen::NumTraits<gyrostat::Pack<Target, N>> : Eigen::NumTraits<double> {
  using Real = gyrostat::Pack<Target, N>;
  using NonInteger = Real;
  using Nested = Real;
  enum { RequireInitialization = 0 };
};
