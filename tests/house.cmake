# SPDX-License-Identifier: BSL-1.0
# Tests of the house: its style, the single header, and the ways in which others take gnomon in.
# Tests that miss a tool leave with 77 and count as skipped.

# ---- Style: ctest -L style ----------------------------------------------------------------------

set(tools ${PROJECT_SOURCE_DIR}/tools)
function(add_style_test name)
    add_test(NAME style.${name} COMMAND ${ARGN} COMMAND_EXPAND_LISTS)
    set_tests_properties(style.${name} PROPERTIES
        LABELS style SKIP_RETURN_CODE 77 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endfunction()

add_style_test(single_header_is_fresh Python3::Interpreter ${tools}/amalgamate.py --check)
add_style_test(floors Python3::Interpreter ${tools}/check_floors.py)
add_style_test(mirror Python3::Interpreter ${tools}/check_mirror.py)
add_style_test(snippets Python3::Interpreter ${tools}/check_snippets.py)
add_style_test(format sh ${tools}/check_format.sh)
add_style_test(include_budget
    Python3::Interpreter ${tools}/include_budget.py "${check_syntax}")

# ---- Single header: every test once more, with only the generated file on the include path -------

# Made afresh here, so that the tests never lag behind the headers; that the file in the repository
# is the same, style.single_header_is_fresh sees to.
set(single_dir ${CMAKE_CURRENT_BINARY_DIR}/single_header)
set(single_header ${single_dir}/gnomon/gnomon.hpp)
add_custom_command(
    OUTPUT ${single_header}
    COMMAND Python3::Interpreter ${tools}/amalgamate.py --output ${single_header}
    DEPENDS ${headers} ${tools}/amalgamate.py
    COMMENT "Generating the single header")
foreach(header IN LISTS headers)
    cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/include)
    if(header STREQUAL "gnomon/normals/registry.hpp")  # outside: it needs Boost
        file(COPY ${PROJECT_SOURCE_DIR}/include/${header} DESTINATION ${single_dir}/gnomon/normals)
    elseif(NOT header STREQUAL "gnomon/gnomon.hpp")
        file(CONFIGURE OUTPUT ${single_dir}/${header}
             CONTENT "#pragma once\n#include <gnomon/gnomon.hpp>\n")
    endif()
endforeach()

add_library(single_settings INTERFACE)
target_include_directories(single_settings INTERFACE ${single_dir})
target_compile_features(single_settings INTERFACE cxx_std_20)
target_compile_options(single_settings INTERFACE -O0)
target_link_libraries(single_settings INTERFACE
    test_settings Eigen3::Eigen nanoflann::nanoflann Threads::Threads)

add_library(single_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp ${single_header})
target_link_libraries(single_headers PRIVATE single_settings)
target_precompile_headers(single_headers PRIVATE ${precompiled} <gnomon/gnomon.hpp>)

# Compiled and linked as all others, but run against the headers only.
set(slow_when_unoptimised neighborhoods normals occlusion simulation scans)

foreach(floor IN LISTS floors)
    file(GLOB sources CONFIGURE_DEPENDS ${floor}/*_test.cpp)
    if(sources)
        add_executable(${floor}_tests_single ${sources})
        target_link_libraries(${floor}_tests_single PRIVATE single_settings ${oracles_of_${floor}})
        target_precompile_headers(${floor}_tests_single REUSE_FROM single_headers)
        set_target_properties(${floor}_tests_single PROPERTIES
            UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
        if(NOT floor IN_LIST slow_when_unoptimised)
            add_test(NAME single_header.${floor} COMMAND ${floor}_tests_single)
            set_tests_properties(single_header.${floor} PROPERTIES LABELS single_header TIMEOUT 600)
        endif()
    endif()
endforeach()

# ---- Packaging: ctest -L package -----------------------------------------------------------------

# Small projects of other people, configured, built and run: add_consumer(NAME [cmake options...]).
set(consumers ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
set(consumer_dir ${CMAKE_CURRENT_BINARY_DIR}/consumer)
function(add_consumer name)
    add_test(NAME package.${name}
        COMMAND ${CMAKE_CTEST_COMMAND}
            --build-and-test ${consumers}/${name} ${consumer_dir}/${name}
            --build-generator ${CMAKE_GENERATOR} --build-noclean --build-options
            -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} ${ARGN}
            --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)
    set_tests_properties(package.${name} PROPERTIES LABELS package)
endfunction()

add_consumer(add_subdirectory -DGNOMON_SOURCE_DIR=${PROJECT_SOURCE_DIR})
add_consumer(fetch_content -DFETCHCONTENT_SOURCE_DIR_GNOMON=${PROJECT_SOURCE_DIR})
add_consumer(two_translation_units -DGNOMON_SOURCE_DIR=${PROJECT_SOURCE_DIR})
add_consumer(single_header -DGNOMON_SINGLE_INCLUDE=${PROJECT_SOURCE_DIR}/single_include)

if(GNOMON_INSTALL)
    set(prefix ${consumer_dir}/prefix)
    add_test(NAME package.install
        COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
    add_consumer(find_package -DCMAKE_PREFIX_PATH=${prefix})
    add_test(NAME package.pkg_config COMMAND sh ${consumers}/pkg_config.sh
        ${prefix}/${CMAKE_INSTALL_DATADIR}/pkgconfig ${consumer_dir}/pkg_config
        ${CMAKE_CXX_COMPILER})
    set_tests_properties(package.install PROPERTIES LABELS package FIXTURES_SETUP prefix)
    set_tests_properties(package.find_package PROPERTIES FIXTURES_REQUIRED prefix)
    set_tests_properties(package.pkg_config PROPERTIES
        LABELS package FIXTURES_REQUIRED prefix SKIP_RETURN_CODE 77)
endif()
