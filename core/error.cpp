#include <gyrostat/core/error.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace gyrostat {
namespace {

/// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({above[j - 1] + change, row[j - 1] + 1, above[j] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above.back();
}

/// Edit distance, but a name that only lacks its end is next to the whole one.
std::size_t distance(std::string_view name, std::string_view candidate) {
  const bool shortened = name.size() >= 3 && candidate.starts_with(name);
  return shortened ? 1 : edit_distance(name, candidate);
}

}  // namespace

std::string sample_place(std::string_view file, std::size_t first_row, std::size_t index) {
  return first_row == 0 ? std::string(file) + ": row " + std::to_string(index + 1)
                        : std::string(file) + ":" + std::to_string(first_row + index);
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  // Of two that are as near, the one that begins alike: 'alan' is 'allan' rather than 'plan'.
  const auto alike = [&](std::string_view candidate) {
    const auto end = std::mismatch(name.begin(), name.end(), candidate.begin(), candidate.end());
    return end.first - name.begin();
  };
  const auto nearest =
      std::min_element(candidates.begin(), candidates.end(), [&](const auto& a, const auto& b) {
        return std::pair(distance(name, a), -alike(a)) < std::pair(distance(name, b), -alike(b));
      });
  return nearest == candidates.end() ? std::string{} : *nearest;
}

bool is_misspelling(std::string_view name, std::string_view meant) {
  return distance(name, meant) <= 1 + meant.size() / 4;
}

std::string unknown_name(std::string_view kind, std::string_view name,
                         std::span<const std::string> candidates) {
  std::string message = "unknown " + std::string(kind) + " '" + std::string(name) + "'";
  const auto nearest = nearest_name(name, candidates);
  return nearest.empty() ? message : message + "; did you mean '" + nearest + "'?";
}

}  // namespace gyrostat
