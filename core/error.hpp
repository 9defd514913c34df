#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gyrostat {

/// What the user handed in cannot be used: one line that names the place, the value and what would
/// do.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view place, std::string_view problem)
      : std::runtime_error(std::string(place) + (place.ends_with(':') ? " " : ": ") +
                           std::string(problem)) {}
};

/// Where sample `index` of a file stands: "file:line" where its sample 0 is in line `first_row`,
/// "file: row n" where the file has no lines (0).
std::string sample_place(std::string_view file, std::size_t first_row, std::size_t index);

/// The candidate with the smallest edit distance to `name`; empty when there are no candidates.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// Whether `name` is close enough to `meant` to have been meant so.
bool is_misspelling(std::string_view name, std::string_view meant);

/// "unknown <kind> 'name'; did you mean 'nearest'?"
std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string> candidates);

}  // namespace gyrostat
