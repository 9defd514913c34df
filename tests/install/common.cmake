# What the tests of the installed package share: where it is, how to run a command, how to configure a project
# with the compiler and flags of the build and nothing else of it in sight.
foreach(folder BUILD_DIR SOURCE_DIR)
  if(NOT ${folder})
    message(FATAL_ERROR "-D${folder}=... is missing")
  endif()
  get_filename_component(${folder} "${${folder}}" ABSOLUTE)
endforeach()
set(prefix ${BUILD_DIR}/install_check/prefix)

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result}):\n${output}")
  endif()
  message(STATUS "${what}: done")
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(as_outside -DCMAKE_PREFIX_PATH=${prefix})
file(STRINGS ${BUILD_DIR}/CMakeCache.txt entries
     REGEX "^(CMAKE_CXX_COMPILER|CMAKE_BUILD_TYPE|CMAKE_CXX_FLAGS[A-Z_]*|CMAKE_GENERATOR):")
foreach(entry IN LISTS entries)
  if(entry MATCHES "^CMAKE_GENERATOR:[A-Z]+=(.*)$")
    list(APPEND as_outside -G ${CMAKE_MATCH_1})
  else()
    list(APPEND as_outside "-D${entry}")
  endif()
endforeach()
