# What the fuzzers throw documents at: one target a file of fuzz/targets, in the test program fuzz_tests, which any
# compiler builds, and with GYROSTAT_FUZZ (the preset `fuzz`) in the program gyrostat_fuzz, which libFuzzer drives.
gyrostat_functions(FOLDER tests/fuzz/targets PRELUDE "#include <gyrostat/tests/fuzz/target.hpp>\n\n"
                   NAMESPACE gyrostat::fuzz SOURCE fuzz_calls
                   DECLARE "Target target_@id@()"
                   DEFINE "void append_targets(std::map<std::string, Target>& to)"
                   CALL "to.emplace(\"@id@\", target_@id@())")
file(GLOB fuzz_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/fuzz/targets/*.cpp)
add_library(gyrostat_fuzz_targets STATIC EXCLUDE_FROM_ALL ${fuzz_sources} ${fuzz_calls}
            ${PROJECT_SOURCE_DIR}/tests/fuzz/target.cpp ${PROJECT_SOURCE_DIR}/tests/recordings/log_bytes.cpp)
target_link_libraries(gyrostat_fuzz_targets PUBLIC gyrostat_experiments PRIVATE gyrostat_test_places gyrostat_warnings)
target_compile_options(gyrostat_fuzz_targets PRIVATE $<$<CONFIG:Release>:-O1>)
gyrostat_together(gyrostat_fuzz_targets 30)

if(GYROSTAT_FUZZ)
  add_executable(gyrostat_fuzz ${PROJECT_SOURCE_DIR}/tests/fuzz/fuzzer.cpp)
  target_link_libraries(gyrostat_fuzz PRIVATE gyrostat_fuzz_targets gyrostat_warnings)
  target_link_options(gyrostat_fuzz PRIVATE -fsanitize=fuzzer)
endif()
