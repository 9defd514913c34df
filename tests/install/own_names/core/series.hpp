#pragma once

#include <vector>

#include <core/types.hpp>

struct Series {
  std::vector<Sample> samples;
};
