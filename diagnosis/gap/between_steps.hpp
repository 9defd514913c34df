#pragma once

#include <vector>

namespace gyrostat::gap {

/// What a rounded quantity was between its steps. When it crosses from one value to the next is
/// better known than what it is in between: a run of equal values becomes straight from crossing to
/// crossing; the first and the last go on as the runs beside them, as far as their value allows.
/// A run in which it turns keeps its value, and so does what steps by less than `least_step`, as
/// the last digits of a computer's numbers do, or never repeats.
std::vector<double> between_steps(std::vector<double> values, double least_step);

}  // namespace gyrostat::gap
