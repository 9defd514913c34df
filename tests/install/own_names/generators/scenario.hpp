#pragma once

#include <core/series.hpp>

struct Scenario {
  int samples = 0;
  Series make() const { return {std::vector<Sample>(static_cast<unsigned>(samples), 1.0f)}; }
};
