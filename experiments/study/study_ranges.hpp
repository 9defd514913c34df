#pragma once

#include <gyrostat/core/fields.hpp>

/// What the numbers of a study file may be that are no parameters of a scenario, an effect or a
/// filter.
namespace gyrostat::study_ranges {

inline constexpr Range trials{.from = 1, .to = 1e8, .whole = true};
inline constexpr Range budget{.from = 1, .to = 100000, .whole = true};
inline constexpr Range points{.from = 1, .to = 1e6, .whole = true};
inline constexpr Range levels{.from = 2, .to = 1000, .whole = true};
inline constexpr Range first_look{.from = 10, .to = 1e8, .whole = true};
inline constexpr Range runs{.from = 2, .to = 1000, .whole = true};
inline constexpr Range level_samples{.from = 100, .to = 100000, .whole = true};
inline constexpr Range subset_levels{.from = 1, .to = 20, .whole = true};
inline constexpr Range share{.from = 0.0, .to = 1.0};
inline constexpr Range seed{.from = 0, .to = 9007199254740992.0, .whole = true};

}  // namespace gyrostat::study_ranges
