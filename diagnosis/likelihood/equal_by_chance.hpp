#pragma once

#include <vector>

namespace gyrostat::gap {

/// Samples that would equal the one before if none was repeated. On a fine grid as many as differ
/// from it by each of the next steps: the density of differences is level there to two percent.
/// Else by how many differ from it by one and by two steps: differences are normal; -1 where they
/// are not, or too few differ to tell.
double equal_by_chance(const std::vector<double>& differences, double step);

/// The step of a grid that something slow has moved, as a firmware's compensation does: neighbours
/// differ by hardly anything or by about a whole number of steps; 0 where they do not.
double step_of_moved_grid(const std::vector<double>& differences);

}  // namespace gyrostat::gap
