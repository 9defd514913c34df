#pragma once

#include <string>

#include <gyrostat/experiments/cli/verbs.hpp>
#include <gyrostat/results/render/render.hpp>

namespace gyrostat::cli {

/// Prints the answer above the tables, where these are for people; nothing where it is empty. Bold
/// on a terminal, unless NO_COLOR is set (no-color.org) or the terminal is dumb.
void print_answer(Console& console, Format format, const std::string& answer);

}  // namespace gyrostat::cli
