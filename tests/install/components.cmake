# cmake -DBUILD_DIR=build/release -DSOURCE_DIR=. -P tests/install/components.cmake
#
# Each component is found where all is hidden but what it needs; without what it needs it says what that is; a
# component that does not exist is answered with those that do.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

set(packages Eigen3 Ceres Boost fmt nlohmann_json SQLite3 ZLIB BZip2 PkgConfig FastFloat TBB CLI11)
set(needs_core Eigen3)
set(needs_generators Eigen3)
set(needs_analysis Eigen3 Ceres Boost)
set(needs_results Eigen3 fmt nlohmann_json SQLite3)
set(needs_recordings Eigen3 fmt ZLIB BZip2 SQLite3 PkgConfig)
set(needs_diagnosis Eigen3 Ceres Boost TBB fmt nlohmann_json)
set(needs_experiments ${needs_diagnosis} ${needs_results} ${needs_recordings})

set(build ${BUILD_DIR}/install_check/components)
file(REMOVE_RECURSE ${build})

# Configures with these components where only these packages are to be found; `finds` is whether that goes well.
function(configure finds components)
  set(hidden "")
  foreach(package IN LISTS packages)
    set(hide ON)
    if(package IN_LIST ARGN)
      set(hide OFF)
    endif()
    list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=${hide})
  endforeach()
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install/components -B ${build} ${as_outside}
                          "-DCOMPONENTS=${components}" ${hidden}
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(finds AND NOT result EQUAL 0)
    message(FATAL_ERROR "COMPONENTS ${components} with ${ARGN}:\n${output}")
  elseif(NOT finds AND result EQUAL 0)
    message(FATAL_ERROR "COMPONENTS ${components} is found with ${ARGN} alone")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(says text)
  string(FIND "${output}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "not said: ${text}\n${output}")
  endif()
endfunction()

foreach(room core generators analysis results recordings diagnosis experiments)
  configure(TRUE ${room} ${needs_${room}})
endforeach()
configure(TRUE "" Eigen3)
says("found: core generators;")
configure(TRUE "" ${packages})
says("found: core generators analysis results recordings diagnosis experiments;")
configure(FALSE analysis Eigen3 Boost)
says("gyrostat::analysis needs Ceres 2.1.")
configure(FALSE recordings Eigen3 fmt ZLIB BZip2 SQLite3)
says("gyrostat::recordings needs liblz4, found by pkg-config, libzstd, found by pkg-config.")
configure(FALSE filters ${packages})
says("gyrostat has no component 'filters'; it has core, generators, analysis, results, recordings, diagnosis, experiments.")
