#pragma once

#include <optional>
#include <span>
#include <string>

#include <gyrostat/analysis/spectra/allan.hpp>
#include <gyrostat/analysis/spectra/allan_coefficients.hpp>
#include <gyrostat/core/table.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {

/// The Allan deviation of a recording with its 95 % band, dps over s, and what its coefficients
/// amount to.
Picture recording_allan_picture(std::span<const AllanPoint> points,
                                const std::optional<AllanCoefficients>& coefficients,
                                const std::string& title);

/// A page of a picture and tables; `name` is that of the recording.
std::string recording_page(const std::string& name, const Picture& picture,
                           std::span<const Table> tables);

}  // namespace gyrostat
