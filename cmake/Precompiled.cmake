# What most sources of a target read, and what takes long to read, is read once for all of them. The list of each
# target is what was measured to help; a header that few of its sources use makes the others slower.
option(GYROSTAT_PRECOMPILE "Precompile long headers" ON)

function(gyrostat_precompile target)
  if(GYROSTAT_PRECOMPILE AND TARGET ${target})
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

set(std_headers <algorithm> <array> <cmath> <functional> <map> <optional> <span> <string> <vector>)
set(eigen_headers <Eigen/Cholesky> <Eigen/LU> <Eigen/QR>)
set(text_headers <filesystem> <fmt/format.h> <fmt/ranges.h> <nlohmann/json.hpp>)

gyrostat_precompile(gyrostat_core ${std_headers} ${eigen_headers})
gyrostat_precompile(gyrostat_analysis ${std_headers} ${eigen_headers})
gyrostat_precompile(gyrostat_diagnosis ${std_headers} ${eigen_headers} <fmt/format.h> <fmt/ranges.h>)
gyrostat_precompile(gyrostat_results ${std_headers} ${text_headers})
gyrostat_precompile(gyrostat_experiments ${std_headers} ${text_headers})
gyrostat_precompile(gyrostat_cli ${std_headers} ${text_headers} <CLI/CLI.hpp>)
