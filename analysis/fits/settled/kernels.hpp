#pragma once

#include <cstddef>
#include <span>

namespace gyrostat {

/// Recursions of ArimaInnovations whose gains are kept, of so many models side by side: a recursion
/// waits for itself, several fill the wait.
struct SettledModels {
  static constexpr std::size_t lanes = 8;
  double x[lanes], e[lanes];
  double phi[lanes], gain_x[lanes], gain_e[lanes];
  double squares[lanes];  ///< sum nu^2
};

/// One such recursion with the derivatives (d_) of its state and gains by four parameters.
struct SettledDerivatives {
  static constexpr std::size_t by = 4;
  double x, e, phi, gain_x, gain_e;
  double d_x[by], d_e[by], d_phi[by], d_gain_x[by], d_gain_e[by];
  double squares;           ///< sum nu^2
  double mixed[by];         ///< sum nu d nu
  double products[by][by];  ///< sum d nu d nu^T
};

/// Moves them on over samples none of which is missing, and adds to their sums. Recursions with
/// derivatives go up to three at a time.
struct SettledKernel {
  void (*models)(std::span<const double> z, SettledModels& of) = nullptr;
  void (*derivatives)(std::span<const double> z, std::span<SettledDerivatives> of) = nullptr;
};

/// That of the widest instruction set of this machine; each gives the same bits.
const SettledKernel& settled_kernel();

}  // namespace gyrostat
