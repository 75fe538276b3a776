# SPDX-License-Identifier: BSL-1.0
# Planes and smooth parts beside those of PCL and CGAL, where these are found. A function, as the
# packages of others leave much behind.
function(add_plane_segmentation)
    set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
    set(GNOMON_SHARED_DATA_DIR ${PROJECT_SOURCE_DIR}/../shared/data CACHE PATH
        "Scans and truth too large for the repository; tests that need them are skipped without")
    cmake_path(NORMAL_PATH GNOMON_SHARED_DATA_DIR OUTPUT_VARIABLE shared_data)
    add_executable(plane_segmentation
        ${here}/plane_segmentation.cpp ${here}/plane_methods_gnomon.cpp)
    target_link_libraries(plane_segmentation PRIVATE gnomon::gnomon)
    target_compile_definitions(plane_segmentation PRIVATE "PLANES_DATA=\"${shared_data}\"")

    find_package(PkgConfig QUIET)
    if(PkgConfig_FOUND)
        pkg_check_modules(PLANES_PCL QUIET IMPORTED_TARGET pcl_features pcl_segmentation)
    endif()
    if(TARGET PkgConfig::PLANES_PCL)
        target_sources(plane_segmentation PRIVATE ${here}/plane_methods_pcl.cpp)
        target_link_libraries(plane_segmentation PRIVATE PkgConfig::PLANES_PCL)
        target_compile_definitions(plane_segmentation PRIVATE PLANES_PCL)
    endif()

    # CGAL is headers that need two libraries, and rounding left alone.
    find_path(CGAL_INCLUDE_DIR CGAL/jet_estimate_normals.h)
    if(CGAL_INCLUDE_DIR)
        target_sources(plane_segmentation PRIVATE ${here}/plane_methods_cgal.cpp)
        set_source_files_properties(${here}/plane_methods_cgal.cpp PROPERTIES
            COMPILE_DEFINITIONS CGAL_EIGEN3_ENABLED COMPILE_OPTIONS -frounding-math)
        target_link_libraries(plane_segmentation PRIVATE mpfr gmp)
        target_compile_definitions(plane_segmentation PRIVATE PLANES_CGAL)
    endif()

    add_dependencies(benchmarks plane_segmentation)
    if(GNOMON_BUILD_TESTS)
        add_test(NAME benchmark.plane_segmentation COMMAND plane_segmentation --quick)
        set_tests_properties(benchmark.plane_segmentation PROPERTIES LABELS benchmark)
    endif()
endfunction()

add_plane_segmentation()
