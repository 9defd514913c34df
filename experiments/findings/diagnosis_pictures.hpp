#pragma once

#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat::gap {

/// The whole gap, what each effect closes of it, and what is left.
Picture waterfall_picture(const Diagnosis& diagnosis);

/// The recording over time, and what is left of it: for people, in dps.
std::vector<Picture> recording_pictures(const Diagnosis& diagnosis);

/// Allan deviation and spectrum, of the recording and of the simulator before and after.
std::vector<Picture> noise_pictures(const Diagnosis& diagnosis);

/// A metric of the filters each: recording, simulator before and after.
std::vector<Picture> filter_pictures(const Diagnosis& diagnosis);

/// All of these, and those of every lens, that have something to show, in the order of the page.
std::vector<Picture> diagnosis_pictures(const Diagnosis& diagnosis);

}  // namespace gyrostat::gap
