# The package: one component a room, each with the targets file of its own, so that who wants `core` needs no
# more than core does. Headers are installed under include/gyrostat/ROOM as they stand in the tree, with those
# generated headers that they include; tests, benchmarks and the command line are none of the library.
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gyrostat)
set(components core generators analysis results recordings diagnosis experiments)

foreach(room IN LISTS components)
  set(targets gyrostat_${room})
  if(room STREQUAL core)
    list(APPEND targets gyrostat_flags)
  endif()
  install(TARGETS ${targets} EXPORT gyrostat_${room}_targets)
  install(EXPORT gyrostat_${room}_targets NAMESPACE gyrostat:: FILE gyrostat_${room}Targets.cmake
          DESTINATION ${package})
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gyrostat FILES_MATCHING PATTERN "*.hpp"
          PATTERN "experiments/benchmarks" EXCLUDE PATTERN "experiments/cli" EXCLUDE
          PATTERN "published" EXCLUDE PATTERN "studies" EXCLUDE PATTERN "script" EXCLUDE
          PATTERN "report/pictures" EXCLUDE)
  # The lists of plug-ins: what else is generated is included by sources alone.
  file(GLOB_RECURSE lists RELATIVE ${PROJECT_BINARY_DIR}/generated ${PROJECT_BINARY_DIR}/generated/gyrostat/${room}/list.hpp)
  foreach(list IN LISTS lists)
    get_filename_component(folder ${list} DIRECTORY)
    install(FILES ${PROJECT_BINARY_DIR}/generated/${list} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder})
  endforeach()
endforeach()
install(TARGETS gyrostat)
# What plug-ins are written against, under the name that they include.
install(FILES experiments/plugins/gyrostat_plugin.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

configure_package_config_file(cmake/gyrostatConfig.cmake.in gyrostatConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(gyrostatConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gyrostatConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gyrostatConfigVersion.cmake
        DESTINATION ${package})
