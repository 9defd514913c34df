#pragma once

#include <cstdint>
#include <string>

#include <gyrostat/experiments/study/study.hpp>

namespace gyrostat {

/// One method in one trial of a study.
struct TrialAddress {
  std::size_t cell = 0, method = 0;
  std::uint32_t trial = 0;
};

/// "study:cell:trial:filter", by which quarantined trials are called.
std::string address_text(const std::string& study, const std::string& cell, std::uint32_t trial,
                         const std::string& method);

/// The study's name in an address: what stands before the first colon.
std::string study_of_address(const std::string& address);

/// What an address means in a study. Throws InputError with the nearest known name for a cell or
/// filter that the study has not, and with the allowed range for a trial beyond its cell's.
TrialAddress parse_address(const std::string& address, const Study& study);

}  // namespace gyrostat
