# SPDX-License-Identifier: BSL-1.0
# headers_alone, which is built on demand: compiles each header by itself, as its user may include no
# other. Most of that time would be Eigen's. A header that includes <Eigen/Core>, itself or by another,
# gets it precompiled: what it lacks is still missing, as all includes stand above what needs them, and
# those that it includes are compiled by themselves, too. Which these are is read when CMake runs.

set(pending)
foreach(header IN LISTS headers)
    cmake_path(RELATIVE_PATH header BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/include OUTPUT_VARIABLE name)
    file(STRINGS ${header} included_by_${name} REGEX "^#include <(gnomon/|Eigen/Core>)")
    list(TRANSFORM included_by_${name} REPLACE "^#include <([^>]+)>.*" "\\1")
    list(APPEND pending ${name})
endforeach()

# Those with Eigen, then those that include one of them, until there are no more.
set(with_eigen Eigen/Core)
set(names_with_eigen)
set(found ${with_eigen})
while(found)
    set(found)
    foreach(name IN LISTS pending)
        foreach(included IN LISTS included_by_${name})
            if(included IN_LIST with_eigen)
                list(APPEND found ${name})
                break()
            endif()
        endforeach()
    endforeach()
    list(APPEND with_eigen ${found})
    list(APPEND names_with_eigen ${found})
    list(REMOVE_ITEM pending "" ${found})
endwhile()

# add_headers_alone(NAME HEADER...)
function(add_headers_alone target)
    set(sources)
    foreach(name IN LISTS ARGN)
        set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "#include <${name}>\n")
        list(APPEND sources ${source})
    endforeach()
    add_library(${target} OBJECT EXCLUDE_FROM_ALL ${sources})
    target_link_libraries(${target} PRIVATE gnomon::gnomon)
    set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
    target_compile_definitions(${target} PRIVATE near= far=)  # as <windows.h> defines them
endfunction()
add_headers_alone(headers_without_eigen ${pending})
add_headers_alone(headers_with_eigen ${names_with_eigen})
target_precompile_headers(headers_with_eigen PRIVATE <Eigen/Core>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(headers_with_eigen PRIVATE -fpch-preprocess)  # for ccache
endif()
add_custom_target(headers_alone DEPENDS headers_without_eigen headers_with_eigen)
