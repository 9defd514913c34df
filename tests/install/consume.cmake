# cmake -DBUILD_DIR=build/release -DSOURCE_DIR=. -DPROJECT=examples/own_filter [-DARGUMENTS=…] [-DSIMULATE=STUDY]
#       [-DSAYS=REGEX] -P tests/install/consume.cmake
#
# Configures, builds and runs a project that knows gyrostat only as the installed package. Its program is called as
# its folder, and prints what SAYS matches. SIMULATE: it is given a recording, made of that study by the
# installed program.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)

get_filename_component(name ${PROJECT} NAME)
set(build ${BUILD_DIR}/install_check/${name})
file(REMOVE_RECURSE ${build})
run("configuring ${name}" ${CMAKE_COMMAND} -S ${SOURCE_DIR}/${PROJECT} -B ${build} ${as_outside})
run("building it" ${CMAKE_COMMAND} --build ${build})
if(SIMULATE)
  set(ARGUMENTS ${build}/REC.csv)
  run("simulating a recording" ${prefix}/bin/gyrostat simulate ${SOURCE_DIR}/${SIMULATE} --out ${ARGUMENTS})
endif()
run("running it" ${build}/${name} ${ARGUMENTS})
message("${output}")
if(SAYS AND NOT output MATCHES "${SAYS}")
  message(FATAL_ERROR "${name} does not print what matches '${SAYS}'")
endif()
