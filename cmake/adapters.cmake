# SPDX-License-Identifier: BSL-1.0
# Targets for the headers of gnomon/adapters/, each with the library that it adapts. The same file
# serves the source tree and the installed package.

# Before CMake 3.24, targets of a package are seen only in the directory that finds it and below.
set(gnomon_global)
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.24)
    set(gnomon_global GLOBAL)
endif()

# gnomon_adapter(NAME TARGET PACKAGE [options of find_package...]): gnomon::NAME, if PACKAGE is found
# and has TARGET.
function(gnomon_adapter name target package)
    if(TARGET gnomon::${name})
        return()
    endif()
    if(NOT TARGET ${target})
        find_package(${package} CONFIG QUIET ${gnomon_global})
    endif()
    if(TARGET ${target})
        add_library(gnomon::${name} INTERFACE IMPORTED GLOBAL)
        target_link_libraries(gnomon::${name} INTERFACE gnomon::gnomon ${target})
    endif()
endfunction()

gnomon_adapter(assimp assimp::assimp assimp)
gnomon_adapter(embree embree embree)
gnomon_adapter(json nlohmann_json::nlohmann_json nlohmann_json)
