# SPDX-License-Identifier: BSL-1.0
# add_help_test(LABEL [SCRIPT...]): each program of this folder and those below prints its usage for
# --help, and so do the scripts. Those built on demand are tested where they are there.
function(add_help_test label)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    set(programs)
    get_property(folders DIRECTORY PROPERTY SUBDIRECTORIES)
    foreach(folder IN ITEMS ${CMAKE_CURRENT_SOURCE_DIR} ${folders})
        get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
        foreach(target IN LISTS targets)
            get_target_property(type ${target} TYPE)
            if(type STREQUAL EXECUTABLE)
                list(APPEND programs $<TARGET_FILE:${target}>)
            endif()
        endforeach()
    endforeach()
    add_test(NAME ${label}.help
        COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tests/examples/help_test.py
            ${programs} ${ARGN})
    set_tests_properties(${label}.help PROPERTIES LABELS ${label})
endfunction()
