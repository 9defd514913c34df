# gyrostat_build_info(target)
#
# Gives `target` the header <gyrostat/experiments/run/build_info.hpp>: commit, compiler and flags of this very build.
# Run as a script, it writes that header, and leaves it alone where nothing has changed.
if(CMAKE_SCRIPT_MODE_FILE)
  set(commit "")
  find_program(GIT git)
  if(GIT)
    execute_process(COMMAND ${GIT} describe --always --dirty --abbrev=12 --exclude=*
                    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE commit
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(commit MATCHES "-dirty$")
      execute_process(COMMAND ${GIT} diff HEAD -- . COMMAND ${GIT} hash-object --stdin
                      WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE changes
                      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
      string(SUBSTRING "${changes}" 0 8 changes)
      string(APPEND commit "-${changes}")
    endif()
  endif()
  if(commit STREQUAL "")
    set(commit "no commit")
  endif()
  file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT "#pragma once

#define GYROSTAT_COMMIT \"${commit}\"
#define GYROSTAT_COMPILER \"${COMPILER}\"
#define GYROSTAT_FLAGS \"${FLAGS}\"
")
  return()
endif()

function(gyrostat_build_info target)
  set(header ${PROJECT_BINARY_DIR}/generated/gyrostat/experiments/run/build_info.hpp)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} -ffp-contract=off" flags)
  add_custom_target(gyrostat_build_info_header BYPRODUCTS ${header}
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DHEADER=${header}
            "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_SYSTEM_PROCESSOR}"
            "-DFLAGS=${flags}" -P ${PROJECT_SOURCE_DIR}/cmake/BuildInfo.cmake
    COMMENT "" VERBATIM)
  add_dependencies(${target} gyrostat_build_info_header)
endfunction()
