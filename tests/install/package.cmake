# cmake -DBUILD_DIR=build/release -DSOURCE_DIR=. -P tests/install/package.cmake
#
# Installs the build into a fresh prefix, for the other tests in this folder. Package files name no folder of this
# machine; every header that an installed header includes is installed; what is no library is not.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

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

file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/*)
list(LENGTH headers count)
if(count LESS 100)
  message(FATAL_ERROR "${count} headers are installed")
endif()
foreach(header IN LISTS headers)
  if(NOT header MATCHES "^gyrostat/(core|generators|analysis|results|recordings|diagnosis|experiments)/.*\\.hpp$"
     OR header MATCHES "/(cli|benchmarks|tests)/")
    message(FATAL_ERROR "${header} is installed, which is no header of the library")
  endif()
  file(STRINGS ${prefix}/include/${header} lines REGEX "^#include <gyrostat/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^#include <([^>]*)>.*" "\\1" included "${line}")
    if(NOT EXISTS ${prefix}/include/${included})
      message(FATAL_ERROR "${header} includes <${included}>, which is not installed")
    endif()
  endforeach()
endforeach()
run("running the installed program" ${prefix}/bin/gyrostat list filters --json)
