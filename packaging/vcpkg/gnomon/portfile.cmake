# SPDX-License-Identifier: BSL-1.0
# The source is, in this sequence: the tree that this port is in, the tarball of the release next to
# this file, or that tarball at the public address. tools/packages.py writes the address,
# tools/release.sh the hash.
set(releases "")
set(tarball_sha512 0)

get_filename_component(tree "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(tarball "gnomon-${VERSION}.tar.gz")
if(EXISTS "${tree}/include/gnomon/version.hpp")
    set(SOURCE_PATH "${tree}")
else()
    if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/${tarball}")
        set(archive "${CMAKE_CURRENT_LIST_DIR}/${tarball}")
    elseif(releases)
        vcpkg_download_distfile(archive
            URLS "${releases}/${VERSION}/${tarball}" FILENAME "${tarball}" SHA512 "${tarball_sha512}")
    else()
        message(FATAL_ERROR "gnomon has no public address yet: put ${tarball} into ${CMAKE_CURRENT_LIST_DIR}")
    endif()
    vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")
endif()

set(VCPKG_BUILD_TYPE release)  # headers only
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DGNOMON_BUILD_TESTS=OFF
        -DGNOMON_BUILD_EXAMPLES=OFF
        -DGNOMON_BUILD_BENCHMARKS=OFF
        -DGNOMON_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/gnomon)
file(MAKE_DIRECTORY "${CURRENT_PACKAGES_DIR}/lib")  # where vcpkg expects it
file(RENAME "${CURRENT_PACKAGES_DIR}/share/pkgconfig" "${CURRENT_PACKAGES_DIR}/lib/pkgconfig")
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/licenses")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
