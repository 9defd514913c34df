#pragma once

#include <vector>

#include <gyrostat/diagnosis/gap/conditions.hpp>
#include <gyrostat/diagnosis/likelihood/noise_law.hpp>
#include <gyrostat/diagnosis/likelihood/on_and_off.hpp>

namespace gyrostat::gap {

/// What the envelope of a narrow band tells beyond its spectrum: log-likelihoods over that of
/// normal noise, whose squared envelope is exponential. A sine of constant amplitude that wanders
/// has Rice's (Bell Syst. Tech. J. 24, 1945, 3.10); one that comes and goes a mixture of two, which
/// take turns as a Markov chain.
struct LineShape {
  double wandering = 0.0;
  double bursts = 0.0;
  double amplitude_dps = 0.0;  ///< of the sine
  double on_s = 0.0, off_s = 0.0;
  double on_std_dps = 0.0;
  std::size_t block = 0;  ///< samples over which the envelope was taken
  OnAndOff course{};      ///< of its square, in dps²
};

LineShape line_shape(const Conditions& conditions, const std::vector<double>& left_dps,
                     const Resonance& line);

/// Samples of all parts within a burst of `line`, and a block before and after: a flag a sample.
std::vector<char> samples_in_bursts(const Conditions& conditions,
                                    const std::vector<double>& left_dps, const Resonance& line,
                                    const LineShape& shape);

}  // namespace gyrostat::gap
