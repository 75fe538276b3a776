# SPDX-License-Identifier: BSL-1.0
# gnomon_picture: what the programs that draw pictures need, the stb headers and a font for the labels.

if(TARGET gnomon_picture)
    return()
endif()
find_path(STB_INCLUDE_DIR stb_truetype.h PATH_SUFFIXES stb REQUIRED)
find_file(GNOMON_FONT DejaVuSans.ttf
    PATHS /usr/share/fonts /usr/local/share/fonts
    PATH_SUFFIXES truetype/dejavu TTF dejavu dejavu-sans-fonts
    DOC "TrueType font of the labels of pictures")
add_library(gnomon_picture INTERFACE)
target_include_directories(gnomon_picture INTERFACE ${PROJECT_SOURCE_DIR}/examples)
target_include_directories(gnomon_picture SYSTEM INTERFACE ${STB_INCLUDE_DIR})
if(GNOMON_FONT)
    target_compile_definitions(gnomon_picture INTERFACE "PICTURE_FONT=\"${GNOMON_FONT}\"")
else()
    message(STATUS "DejaVuSans.ttf is missing: pictures have no labels (set GNOMON_FONT to a TrueType font)")
endif()
