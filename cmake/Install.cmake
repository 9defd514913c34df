include(CMakePackageConfigHelpers)

install(TARGETS gyrostat_flags gyrostat_core gyrostat_generators gyrostat_analysis
                gyrostat_results
        EXPORT gyrostat_targets)
install(TARGETS gyrostat)
foreach(room core generators analysis results)
  install(DIRECTORY ${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gyrostat
          FILES_MATCHING PATTERN "*.hpp")
  install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/${room} OPTIONAL
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gyrostat FILES_MATCHING PATTERN "*.hpp")
endforeach()
install(EXPORT gyrostat_targets NAMESPACE gyrostat:: FILE gyrostatTargets.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gyrostat)
configure_package_config_file(cmake/gyrostatConfig.cmake.in gyrostatConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gyrostat)
write_basic_package_version_file(gyrostatConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gyrostatConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gyrostatConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/gyrostat)
