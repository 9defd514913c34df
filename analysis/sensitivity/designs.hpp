#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gyrostat {

/// Points of the unit cube, one a row, one coordinate a parameter.
using Points = std::vector<std::vector<double>>;

/// Where a design's random numbers come from: addresses, as all noise here.
struct DesignSource {
  std::uint64_t seed = 0;
  std::string name;
};

/// `points` points, of which each of as many equal slices of every axis holds one, at random within
/// it. McKay, Beckman and Conover, Technometrics 21, 1979.
Points latin_hypercube(std::size_t points, std::size_t parameters, const DesignSource& source);

/// The first points of the Sobol' sequence (Bratley and Fox, ACM TOMS 14, 1988), the one at 0
/// included, so that a power of two is balanced; with a random digital shift, so that each point
/// alone is uniform.
Points sobol_sequence(std::size_t points, std::size_t parameters, const DesignSource& source);

/// The point `base`, then for each parameter in turn the point with that parameter at 0 and at 1.
Points one_at_a_time(const std::vector<double>& base);

/// Trajectories of parameters + 1 points, each point one step of `morris_step` away from the one
/// before, in another parameter; every start of the grid of `levels` (even) and every order are
/// equally likely. Morris, Technometrics 33, 1991.
Points morris_trajectories(std::size_t trajectories, std::size_t levels, std::size_t parameters,
                           const DesignSource& source);

/// levels / (2 (levels - 1)): half of the grid.
double morris_step(std::size_t levels);

/// Rows of parameters + 2 points: A, B, and A with each parameter in turn from B; A and B are
/// independent and uniform, and so are rows, which a bootstrap of rows needs. Saltelli et al.,
/// Comput. Phys. Commun. 181, 2010.
Points saltelli_rows(std::size_t rows, std::size_t parameters, const DesignSource& source);

}  // namespace gyrostat
