# Headers, libraries, program, CMake package and pkg-config files.
include(CMakePackageConfigHelpers)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/carom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS carom carom_reference EXPORT carom_targets)
if(TARGET carom_program)
  install(TARGETS carom_program OPTIONAL)  # where it has been built
endif()

if(CAROM_BUILD_HULLS)
  install(TARGETS carom_hulls EXPORT carom_hulls_targets)
  install(TARGETS carom_ladders EXPORT carom_ladders_targets)
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/carom)
install(EXPORT carom_targets NAMESPACE carom:: FILE carom-targets.cmake
        DESTINATION ${package_dir})
if(CAROM_BUILD_HULLS)
  install(EXPORT carom_hulls_targets NAMESPACE carom:: FILE carom-hulls-targets.cmake
          DESTINATION ${package_dir})
  install(EXPORT carom_ladders_targets NAMESPACE carom:: FILE carom-ladders-targets.cmake
          DESTINATION ${package_dir})
endif()
configure_package_config_file(cmake/carom-config.cmake.in
                              ${PROJECT_BINARY_DIR}/carom-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/carom-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/carom-config.cmake
              ${PROJECT_BINARY_DIR}/carom-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindHighway.cmake
        DESTINATION ${package_dir})

file(RELATIVE_PATH pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
# What users of the static libraries link and define as well.
if(BUILD_SHARED_LIBS)
  set(pc_requires_private "")
  set(pc_hulls_requires_private "")
  set(pc_ladders_libs_private "")
  set(pc_cflags "")
  set(pc_libs_private "")
else()
  set(pc_requires_private "libhwy tbb")
  set(pc_hulls_requires_private "qhull_r")
  set(pc_ladders_libs_private "-lmeshoptimizer")
  set(pc_cflags " -DCAROM_STATIC")
  set(pc_libs_private "-lstdc++ -lm -pthread")
endif()
set(packages carom carom-reference)
if(CAROM_BUILD_HULLS)
  list(APPEND packages carom-hulls carom-ladders)
endif()
foreach(name IN LISTS packages)
  configure_file(cmake/${name}.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
