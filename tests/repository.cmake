# SPDX-License-Identifier: BSL-1.0
# Tests of the repository: its style, the single header, and the ways in which other projects take
# gnomon in. Tests that miss a tool leave with 77 and count as skipped.

# ---- Style: ctest -L style ----------------------------------------------------------------------

set(tools ${PROJECT_SOURCE_DIR}/tools)
function(add_style_test name)
    add_test(NAME style.${name} COMMAND ${ARGN} COMMAND_EXPAND_LISTS)
    set_tests_properties(style.${name} PROPERTIES
        LABELS style SKIP_RETURN_CODE 77 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endfunction()

add_style_test(single_header_is_fresh Python3::Interpreter ${tools}/amalgamate.py --check)
add_style_test(one_version Python3::Interpreter ${tools}/packages.py --check)
add_style_test(floors Python3::Interpreter ${tools}/check_floors.py)
add_style_test(mirror Python3::Interpreter ${tools}/check_mirror.py)
add_style_test(public_names Python3::Interpreter ${tools}/public_names.py)
add_style_test(sizes Python3::Interpreter ${tools}/check_sizes.py)
add_style_test(constants Python3::Interpreter ${tools}/constants.py)
add_style_test(concepts Python3::Interpreter ${tools}/check_concepts.py)
add_style_test(words Python3::Interpreter ${tools}/check_words.py)
add_style_test(references Python3::Interpreter ${tools}/check_references.py)
# That these can fail, on small trees that break each rule.
add_style_test(tools Python3::Interpreter -m unittest discover -s tests/tools -p "*_test.py")
add_style_test(snippets Python3::Interpreter ${tools}/check_snippets.py)
add_style_test(help Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/examples/help_test.py
    ${CMAKE_CURRENT_SOURCE_DIR}/run.sh ${CMAKE_CURRENT_SOURCE_DIR}/sanitize.sh
    ${CMAKE_CURRENT_SOURCE_DIR}/matrix.sh ${PROJECT_SOURCE_DIR}/docs/build.sh)
# The reference has no undocumented name, no broken link, and all names near its start; without doxygen
# it is not built.
add_style_test(site sh docs/build.sh --test ${CMAKE_CURRENT_BINARY_DIR}/site)
# The pages of results in the repository are what their measurements say.
file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/benchmarks/*/page.py)
foreach(page IN LISTS pages)
    cmake_path(GET page PARENT_PATH folder)
    cmake_path(GET folder FILENAME name)
    add_style_test(page_of_${name} sh ${PROJECT_SOURCE_DIR}/benchmarks/check_page.sh ${name})
endforeach()
add_style_test(format sh ${tools}/check_format.sh)
# GCC collects its garbage each time that its memory has doubled, which at some size makes one line
# more cost a twelfth of everything, and at another size on another machine: it need not, for this.
set(budget_flags)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(budget_flags --param=ggc-min-heapsize=4194304)
endif()
add_style_test(include_budget
    Python3::Interpreter ${tools}/include_budget.py "${check_syntax}" ${budget_flags})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_style_test(compile_budget Python3::Interpreter ${tools}/compile_budget.py
        ${CMAKE_CXX_COMPILER} -std=c++20 -O2 -c "-I$<JOIN:${include_dirs},$<SEMICOLON>-I>"
        ${budget_flags})
endif()

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

# Forms of packages, each made from a tarball of this tree, installed and used. Not all: pkg-config and
# the single header are tested above, and Debian's needs a mirror (sh packaging/test.sh debian).
foreach(form IN ITEMS vcpkg conan cpack ros)
    add_test(NAME package.form.${form} COMMAND sh ${PROJECT_SOURCE_DIR}/packaging/test.sh ${form})
    set_tests_properties(package.form.${form} PROPERTIES LABELS package TIMEOUT 600
        ENVIRONMENT CXX=${CMAKE_CXX_COMPILER})
endforeach()
