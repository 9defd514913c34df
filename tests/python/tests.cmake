# The Python package, in the build tree and installed by pip. Without it, or without what a test needs beside, each
# says so and is skipped.
file(GLOB python_tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*_test.py)
foreach(test IN LISTS python_tests)
  get_filename_component(name ${test} NAME_WE)
  string(REPLACE "_test" "" name ${name})
  if(TARGET gyrostat_python)
    add_test(NAME Python.${name} COMMAND ${DEBIAN_PYTHON} ${test})
    set_tests_properties(Python.${name} PROPERTIES COST 10 ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;GYROSTAT_PROGRAM=$<TARGET_FILE:gyrostat>;GYROSTAT_BUILD_DIR=${PROJECT_BINARY_DIR};GYROSTAT_SOURCE_DIR=${PROJECT_SOURCE_DIR}")
  else()
    add_test(NAME Python.${name}
             COMMAND ${CMAKE_COMMAND} -E echo "SKIPPED: the package is not built, since there is no pybind11")
  endif()
  set_tests_properties(Python.${name} PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED")
endforeach()
