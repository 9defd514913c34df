#pragma once

#include <vector>

#include <gyrostat/diagnosis/start.hpp>
#include <gyrostat/diagnosis/starts/signature.hpp>

namespace gyrostat::gap {

/// One start alone.
template <class E>
std::vector<Start> only(const E& effect) {
  return {Start{effect}};
}

}  // namespace gyrostat::gap
