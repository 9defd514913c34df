# What CONTRIBUTING.md says of adding a filter, an effect, a lens, a metric, a verb and a picture.
add_test(NAME Recipes.ANewPlugInIsOneFile
         COMMAND ${DEBIAN_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/check.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
set_tests_properties(Recipes.ANewPlugInIsOneFile PROPERTIES SKIP_REGULAR_EXPRESSION "SKIPPED:" TIMEOUT 900)
