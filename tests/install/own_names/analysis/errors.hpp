#pragma once

#include <core/series.hpp>

inline double mean_error(const Series& series) {
  double sum = 0.0;
  for (const Sample sample : series.samples) sum += sample;
  return sum / static_cast<double>(series.samples.size());
}
