#pragma once

#include <string>
#include <vector>

#include <gyrostat/diagnosis/diagnosis.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat::gap {

/// What the two simulators are called in every picture.
inline constexpr const char* as_it_stands = "simulator as it stands";
inline constexpr const char* with_the_effects = "simulator with the effects";

Mark mark_of(Mark::Kind kind, const std::string& name, const std::string& colour);

/// What a lens reads along its coordinate, of the recording and of both simulators.
Picture lens_picture(const Band& band, const std::string& id);

/// What a lens says of the simulator with the effects.
enum class Agreement { still_off, mended, always };

struct LensPicture {
  Picture picture;
  Agreement agreement;
  double p;  ///< least of its departures, family-wise
};

/// Of every lens, those that still disagree first, then those that the effects mended; within each
/// the clearest first.
std::vector<LensPicture> lens_pictures(const Diagnosis& diagnosis);

}  // namespace gyrostat::gap
