# SPDX-License-Identifier: BSL-1.0
# What `cmake --install` lays down. Nothing in it depends on the machine, so the package files go to
# share/, where find_package and pkg-config look for such packages.

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/gnomon)

# The include directory is named in addition to the file sets, which a CMake before 3.23 that finds
# the package does not read.
set(file_sets)
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23)
    set(file_sets FILE_SET HEADERS FILE_SET adapters)
else()
    install(DIRECTORY include/gnomon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
install(TARGETS gnomon EXPORT gnomonTargets ${file_sets}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT gnomonTargets NAMESPACE gnomon:: DESTINATION ${package_dir})

configure_package_config_file(
    cmake/gnomonConfig.cmake.in ${PROJECT_BINARY_DIR}/gnomonConfig.cmake
    INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(
    FILES ${PROJECT_BINARY_DIR}/gnomonConfig.cmake ${PROJECT_BINARY_DIR}/gnomonConfigVersion.cmake
          cmake/adapters.cmake
    DESTINATION ${package_dir})

# pkg-config finds the prefix from the place of gnomon.pc, so that the tree can be moved.
set(pkgconfig_dir ${CMAKE_INSTALL_DATADIR}/pkgconfig)
cmake_path(ABSOLUTE_PATH pkgconfig_dir BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}
           OUTPUT_VARIABLE pkgconfig_path)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${pkgconfig_path}
           OUTPUT_VARIABLE pkgconfig_to_prefix)
cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}
           OUTPUT_VARIABLE include_path)
cmake_path(RELATIVE_PATH include_path BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}
           OUTPUT_VARIABLE prefix_to_include)
configure_file(cmake/gnomon.pc.in ${PROJECT_BINARY_DIR}/gnomon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/gnomon.pc DESTINATION ${pkgconfig_dir})

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/gnomon)
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon)  # ROS finds packages by it

# `cpack`, in the build folder: what is installed, as a tarball for any machine.
set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_FILE_NAME gnomon-${PROJECT_VERSION}-headers)
set(CPACK_PACKAGE_VENDOR "The gnomon developers")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_ARCHIVE_THREADS 1)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
