#pragma once

#include <span>
#include <string>

#include <gyrostat/core/table.hpp>
#include <gyrostat/results/pictures/picture.hpp>

namespace gyrostat {

/// A page of a picture and tables; `name` is that of the recording.
std::string recording_page(const std::string& name, const Picture& picture,
                           std::span<const Table> tables);

}  // namespace gyrostat
