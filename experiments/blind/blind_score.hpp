#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gyrostat/core/table.hpp>

namespace gyrostat::gap {

/// Opens the labels of `folder` and scores its diagnoses, shares with 95 % Wilson intervals:
///   aims         every strength: named first, both of a pair named, in the verdict's set, gap
///   closed,
///                abstained with the effect left out
///   effects      the same by effect, and what it was taken for
///   left_out     what each effect was taken for when it was not in the catalogue
///   calibration  how far the stated probabilities can be trusted
///   power        named first by effect, strength and length, where there is more than one length
///   lengths      the same over all effects
/// Recordings without a diagnosis are counted in a note.
std::vector<NamedTable> score_recordings(const std::string& title,
                                         const std::filesystem::path& folder);

}  // namespace gyrostat::gap
