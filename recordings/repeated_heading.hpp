#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace gyrostat {

/// The magnetometer's components beside a heading, sample by sample, in any unit; a component that
/// is empty or missing throughout has no column.
using MagneticField = std::array<std::vector<double>, 3>;

/// Makes missing what a recorder that is faster than its compass wrote again: headings at which no
/// component of the field changed or, without all three components, which are themselves those of
/// the sample before. They are measurements only once, and a filter that takes them for several
/// trusts the compass too much. Nothing is made missing where the values are that coarse that
/// neighbours are equal by chance, or by rest. Returns how many were.
std::size_t leave_out_repeats(std::vector<double>& heading_deg, const MagneticField& field);

}  // namespace gyrostat
