# The installed package, as users of the library see it. The first installs it for the others.
set(install_check ${CMAKE_COMMAND} -DBUILD_DIR=${PROJECT_BINARY_DIR} -DSOURCE_DIR=${PROJECT_SOURCE_DIR})
set(install_tests ${CMAKE_CURRENT_LIST_DIR})

add_test(NAME Install.ThePackageIsWholeAndKnowsNoFolderOfTheBuild
         COMMAND ${install_check} -P ${install_tests}/package.cmake)
set_tests_properties(Install.ThePackageIsWholeAndKnowsNoFolderOfTheBuild PROPERTIES FIXTURES_SETUP package)

function(gyrostat_consumer test)
  add_test(NAME ${test} COMMAND ${install_check} ${ARGN})
  set_tests_properties(${test} PROPERTIES FIXTURES_REQUIRED package)
endfunction()

set(consume -P ${install_tests}/consume.cmake)
gyrostat_consumer(Install.AComponentNeedsOnlyWhatItSays -P ${install_tests}/components.cmake)
gyrostat_consumer(Install.AnOutsideProjectFindsAndLinksTheLibrary -DPROJECT=tests/install/outside ${consume})
gyrostat_consumer(Install.HeadersOfTheSameNameAreKeptApart -DPROJECT=tests/install/own_names ${consume})
gyrostat_consumer(Examples.CompareFilters -DPROJECT=examples/compare_filters
                  "-DSAYS=kf_ma beats kf in bias_rmse by" ${consume})
gyrostat_consumer(Examples.DiagnoseRecording -DPROJECT=examples/diagnose_recording
                  -DSIMULATE=examples/diagnose_recording/coarse.json "-DSAYS=lacks quantization" ${consume})
gyrostat_consumer(Examples.OwnFilter -DPROJECT=examples/own_filter
                  -DARGUMENTS=${PROJECT_SOURCE_DIR}/examples/own_filter/study.json
                  "-DSAYS=beats leaky_mean_200 in bias_rmse by" ${consume})

add_test(NAME Install.TheContainerRecipeBuildsAndRuns
         COMMAND ${DEBIAN_PYTHON} ${install_tests}/check_container.py ${PROJECT_SOURCE_DIR})
set_tests_properties(Install.TheContainerRecipeBuildsAndRuns PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED:" TIMEOUT 3600 COST 90)
