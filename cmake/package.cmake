# Install rules and the CMake package: find_package(trimloop) gives trimloop::io and the layers below it.
include(CMakePackageConfigHelpers)

install(TARGETS trimloop_base trimloop_kernel trimloop_formats trimloop_io EXPORT trimloop
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/trimloop)
install(EXPORT trimloop NAMESPACE trimloop:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trimloop)
configure_package_config_file(cmake/trimloop-config.cmake.in ${PROJECT_BINARY_DIR}/trimloop-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trimloop)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/trimloop-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/trimloop-config.cmake ${PROJECT_BINARY_DIR}/trimloop-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/trimloop)
