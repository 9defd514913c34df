#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <gyrostat/core/series.hpp>

namespace gyrostat::gap {

/// What one diagnosis looks at of a recording: samples [first, first + count), or the means of so
/// many of them.
struct View {
  std::size_t first = 0, count = 0;
  std::size_t mean_of = 1;
};

/// One that is longer is looked at in several views.
inline constexpr std::size_t most_samples_at_once = std::size_t{1} << 22;

/// Whether all values that are not missing are one: nothing can be said of such a gyro.
bool never_changes(std::span<const double> gyro_dps);

/// The views of a recording that together cost no more, however long it is. Up to
/// most_samples_at_once: all of it. Of a longer one: four stretches of 2^19 samples, one in each
/// quarter of it and in the middle there (or beside, where samples are missing or never change), in
/// which what is fast is seen as it is and whether it stays the same; then means over all of it, at
/// most 2^20, in which what is slow is. Between them is only what comes and goes outside the
/// stretches and is shorter than a mean.
std::vector<View> views_of(const Series& recording);

/// What several views look at of so many samples; a sentence.
std::string in_words(const std::vector<View>& views, std::size_t samples);

/// The samples or means of a view. A mean has the weights of a Hann window, so that fast lines are
/// lost rather than folded, and is of the samples that are there, half of them at least; else it is
/// missing. Headings are averaged on the circle, and mag_valid is 0 where any sample's is. What is
/// left at the end is in no mean.
Series looked_at(const Series& recording, const View& view);

}  // namespace gyrostat::gap
