# SPDX-License-Identifier: BSL-1.0
# single_header: what gnomon::gnomon is, with only the generated file on the include path.

# Made afresh here, so that the tests never lag behind the headers; that the file in the repository
# is the same, style.single_header_is_fresh sees to.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(single_dir ${CMAKE_CURRENT_BINARY_DIR}/single_header)
set(single_header ${single_dir}/gnomon/gnomon.hpp)
set(amalgamate ${PROJECT_SOURCE_DIR}/tools/amalgamate.py)
add_custom_command(
    OUTPUT ${single_header}
    COMMAND Python3::Interpreter ${amalgamate} --output ${single_header}
    DEPENDS ${headers} ${amalgamate}
    COMMENT "Generating the single header")
add_custom_target(make_single_header DEPENDS ${single_header})

# The tests name the headers that they are about.
foreach(header IN LISTS headers)
    cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/include)
    # Outside, as they need Boost: the registry, and recognition with what is above it.
    if(header MATCHES "^gnomon/(normals/registry|recognition|recognition/.*|perception/(perceive_views|find_objects|found_object))[.]hpp$")
        configure_file(${PROJECT_SOURCE_DIR}/include/${header} ${single_dir}/${header} COPYONLY)
    elseif(NOT header STREQUAL "gnomon/gnomon.hpp")
        file(CONFIGURE OUTPUT ${single_dir}/${header}
             CONTENT "#pragma once\n#include <gnomon/gnomon.hpp>\n")
    endif()
endforeach()

add_library(single_header INTERFACE)
add_dependencies(single_header make_single_header)
target_include_directories(single_header INTERFACE ${single_dir})
target_compile_features(single_header INTERFACE cxx_std_20)
target_link_libraries(single_header INTERFACE
    Eigen3::Eigen Threads::Threads)
