# gyrostat_kernels(variable)
#
# The filters that pack trials, compiled for each instruction set in UNITS sources each, so that cores share the
# work and a filter that does not pack is in none. Leaves the sources in `variable`, with their flags set, and
# writes <gyrostat/core/packed/units.hpp>, which knows them all.
set(kernel_units 2)
# Whole programs inlined into one function: no sanitizer follows.
set(kernel_options -O3 -DNDEBUG -fno-math-errno -fno-trapping-math -fno-sanitize=all
    -Wno-uninitialized -Wno-maybe-uninitialized)
# GCC stops inlining where a source has grown by two fifths, which here is in the middle of a loop; and it would keep in
# registers what loops load again, which there are too few of. Steps of filters are long, and are put in an order that
# spills less.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND kernel_options --param=inline-unit-growth=1000 -fno-predictive-commoning)
  set(filter_options -fschedule-insns -fsched-pressure)
endif()
set(kernel_flags_sse2 "")
set(kernel_flags_avx2 -mavx2)
set(kernel_flags_avx512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -mprefer-vector-width=512)

set(kernel_targets sse2)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND kernel_targets avx2 avx512)
endif()

# The sources kernels_<target>.cpp and kernels.cpp of a folder, each compiled for its target.
function(gyrostat_kernels_in folder)
  foreach(target sse2 avx2 avx512)
    set(source ${folder}/kernels_${target}.cpp)
    if(target IN_LIST kernel_targets)
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON
        COMPILE_OPTIONS "${kernel_options};${kernel_flags_${target}}")
    else()
      set_source_files_properties(${source} PROPERTIES HEADER_FILE_ONLY ON)
    endif()
  endforeach()
  if(avx2 IN_LIST kernel_targets)
    set_source_files_properties(${folder}/kernels.cpp PROPERTIES COMPILE_DEFINITIONS GYROSTAT_X86
                                SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

function(gyrostat_kernels variable)
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/core/filters/*.hpp)
  list(SORT headers)
  set(count 0)
  foreach(header IN LISTS headers)
    # Whether it packs is what the header says, so a changed header asks anew.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
    file(STRINGS ${PROJECT_SOURCE_DIR}/${header} packs REGEX "packs_trials = true")
    if(NOT packs)
      continue()
    endif()
    get_filename_component(id ${header} NAME_WE)
    gyrostat_type_of(${id} type)
    math(EXPR unit "${count} % ${kernel_units}")
    math(EXPR count "${count} + 1")
    string(APPEND includes_${unit} "#include <gyrostat/${header}>\n")
    list(APPEND entries_${unit} "ScalarPlugin<\"${id}\", filters::${type}>")
  endforeach()

  set(generated ${PROJECT_BINARY_DIR}/generated/gyrostat/core/packed)
  set(sources "")
  set(known "")
  math(EXPR last "${kernel_units} - 1")
  foreach(target IN LISTS kernel_targets)
    string(SUBSTRING ${target} 0 1 head)
    string(SUBSTRING ${target} 1 -1 tail)
    string(TOUPPER ${head} head)
    set(pointers "")
    foreach(unit RANGE ${last})
      list(JOIN entries_${unit} ",\n               " entries)
      set(name filters_${target}_${unit})
      list(APPEND pointers "&${name}")
      string(APPEND known "extern const std::span<const PackedFilter> ${name};\n")
      file(CONFIGURE OUTPUT ${generated}/kernels_${target}_${unit}.cpp @ONLY CONTENT "${includes_${unit}}
#include <gyrostat/core/packed/pack_filter.hpp>
#include <gyrostat/core/packed/target.hpp>

namespace gyrostat {

extern const std::span<const PackedFilter> ${name};

namespace {
constexpr auto packed = pack_filters<targets::${head}${tail}>(
    PluginList<${entries}>{});
}  // namespace

constinit const std::span<const PackedFilter> ${name} = packed;

}  // namespace gyrostat
")
      list(APPEND sources ${generated}/kernels_${target}_${unit}.cpp)
      set_source_files_properties(${generated}/kernels_${target}_${unit}.cpp PROPERTIES
        COMPILE_OPTIONS "${kernel_options};${filter_options};${kernel_flags_${target}}" SKIP_PRECOMPILE_HEADERS ON)
    endforeach()
    list(JOIN pointers ", " pointers)
    string(APPEND known "static constexpr const std::span<const PackedFilter>* filters_${target}[] = {${pointers}};\n")
  endforeach()
  file(CONFIGURE OUTPUT ${generated}/units.hpp @ONLY CONTENT "#pragma once

#include <gyrostat/core/packed/kernels.hpp>

namespace gyrostat {

${known}
}  // namespace gyrostat
")
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()
