#pragma once

#include <gyrostat/experiments/study/json.hpp>

namespace gyrostat {

/// The JSON Schema (draft 7) of study files, from the field lists of scenario, effects and filters.
/// What it refuses `read_study` refuses too, save in a cell whose "grid" puts it right;
/// `read_study` also checks what lies between keys and in other files.
Json study_schema();

}  // namespace gyrostat
