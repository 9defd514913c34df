# Where this build has what tests use: all that they are compiled with hangs on the checkout's place in this source alone.
set(test_plugins ${PROJECT_BINARY_DIR}/tests/plugins)
configure_file(${CMAKE_CURRENT_LIST_DIR}/places.cpp.in ${PROJECT_BINARY_DIR}/tests/places.cpp.in @ONLY)
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/generated/gyrostat/tests/places.cpp
     INPUT ${PROJECT_BINARY_DIR}/tests/places.cpp.in)
add_library(gyrostat_test_places STATIC EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/generated/gyrostat/tests/places.cpp)
target_link_libraries(gyrostat_test_places PRIVATE gyrostat_flags gyrostat_warnings)
target_include_directories(gyrostat_test_places PRIVATE ${include_root})
