#pragma once

#include <gyrostat/analysis/fits/settled/kernels.hpp>
#include <gyrostat/core/numerics/lanes.hpp>
#include <gyrostat/core/packed/pack.hpp>

namespace gyrostat {

/// A SettledKernel for one instruction set; all that it calls is inlined or has `Target` in its
/// name.
template <class Target>
struct SettledOf {
  [[gnu::flatten]] static void models(std::span<const double> z, SettledModels& of) {
    using P = Pack<Target, SettledModels::lanes>;
    const P phi = P::load(of.phi), gain_x = P::load(of.gain_x), gain_e = P::load(of.gain_e);
    P x = P::load(of.x), e = P::load(of.e), squares = P::load(of.squares);
    for (const double sample : z) {
      const P predicted = x + e;
      const P nu = P(sample) - predicted;
      x = predicted + gain_x * nu;
      e = e * phi + gain_e * nu;
      squares += nu * nu;
    }
    x.store(of.x);
    e.store(of.e);
    squares.store(of.squares);
  }

  [[gnu::flatten]] static void derivatives(std::span<const double> z,
                                           std::span<SettledDerivatives> of) {
    for (; of.size() >= 3; of = of.subspan(3))
      together(z, of.data(), Derivatives(of[0]), Derivatives(of[1]), Derivatives(of[2]));
    if (of.size() == 2) together(z, of.data(), Derivatives(of[0]), Derivatives(of[1]));
    if (of.size() == 1) together(z, of.data(), Derivatives(of[0]));
  }

 private:
  static constexpr int by = SettledDerivatives::by;
  using D = Pack<Target, by>;

  struct Derivatives {
    D phi, gain_x, gain_e, d_phi, d_gain_x, d_gain_e;
    D x, e, dx, de, squares, mixed, products[by];

    explicit Derivatives(const SettledDerivatives& of)
        : phi(of.phi),
          gain_x(of.gain_x),
          gain_e(of.gain_e),
          d_phi(D::load(of.d_phi)),
          d_gain_x(D::load(of.d_gain_x)),
          d_gain_e(D::load(of.d_gain_e)),
          x(of.x),
          e(of.e),
          dx(D::load(of.d_x)),
          de(D::load(of.d_e)),
          squares(of.squares),
          mixed(D::load(of.mixed)) {
      unrolled<by>([&]<int i>() { products[i] = D::load(of.products[i]); });
    }

    void take(const D& sample) {
      x += e;
      dx += de;
      de = phi * de + e * d_phi;
      const D nu = sample - x;
      squares += nu * nu;
      mixed -= nu * dx;
      unrolled<by>([&]<int i>() { products[i] += D(dx[i]) * dx; });
      de += nu * d_gain_e - gain_e * dx;
      dx += nu * d_gain_x - gain_x * dx;
      x += gain_x * nu;
      e = phi * e + gain_e * nu;
    }

    void store(SettledDerivatives& of) const {
      of.x = x[0];
      of.e = e[0];
      of.squares = squares[0];
      dx.store(of.d_x);
      de.store(of.d_e);
      mixed.store(of.mixed);
      unrolled<by>([&]<int i>() { products[i].store(of.products[i]); });
    }
  };

  /// Each a variable of its own, which can stay in registers.
  template <class... Each>
  [[gnu::always_inline]] static void together(std::span<const double> z, SettledDerivatives* of,
                                              Each... each) {
    for (const double sample : z) (each.take(D(sample)), ...);
    (each.store(*of++), ...);
  }

 public:
  static constexpr SettledKernel kernel{&models, &derivatives};
};

}  // namespace gyrostat
