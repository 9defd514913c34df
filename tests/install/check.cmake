# cmake -DBUILD_DIR=build/release -DSOURCE_DIR=. -P tests/install/check.cmake
#
# Installs the build into a fresh prefix, then configures, builds and runs the project in this
# folder against it, with the compiler and flags of the build and nothing else of it in sight.
cmake_minimum_required(VERSION 3.25)
foreach(folder BUILD_DIR SOURCE_DIR)
  if(NOT ${folder})
    message(FATAL_ERROR "-D${folder}=... is missing")
  endif()
  get_filename_component(${folder} "${${folder}}" ABSOLUTE)
endforeach()

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result}):\n${output}")
  endif()
  message(STATUS "${what}: done")
endfunction()

set(prefix ${BUILD_DIR}/install_check/prefix)
set(outside ${BUILD_DIR}/install_check/build)
file(REMOVE_RECURSE ${BUILD_DIR}/install_check)

run("installing" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})

file(GLOB_RECURSE package_files ${prefix}/*.cmake)
if(NOT package_files)
  message(FATAL_ERROR "no package file was installed under ${prefix}")
endif()
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  foreach(folder ${BUILD_DIR} ${SOURCE_DIR})
    string(FIND "${text}" "${folder}" at)
    if(NOT at EQUAL -1)
      message(FATAL_ERROR "${file} names ${folder}, which is not there on another machine")
    endif()
  endforeach()
endforeach()

set(same_as_build "")
file(STRINGS ${BUILD_DIR}/CMakeCache.txt entries
     REGEX "^(CMAKE_CXX_COMPILER|CMAKE_BUILD_TYPE|CMAKE_CXX_FLAGS[A-Z_]*|CMAKE_GENERATOR):")
foreach(entry IN LISTS entries)
  if(entry MATCHES "^CMAKE_GENERATOR:[A-Z]+=(.*)$")
    list(APPEND same_as_build -G ${CMAKE_MATCH_1})
  else()
    list(APPEND same_as_build "-D${entry}")
  endif()
endforeach()

run("configuring the outside project"
    ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/install -B ${outside} -DCMAKE_PREFIX_PATH=${prefix}
    ${same_as_build})
run("building it" ${CMAKE_COMMAND} --build ${outside})
run("running it" ${outside}/outside)
run("running the installed program" ${prefix}/bin/gyrostat list filters --json)
