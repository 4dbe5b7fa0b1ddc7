# SPDX-License-Identifier: MIT
# Writes <lodestir/sources.h>: a hash of the C++ that frames and their errors come from, all of framework/ but what commands, windows and reports are made
# by and what rows are summed up with. Results of studies are named by it, so it is made anew with every change of these files, and is the same at any commit and in any folder otherwise.
if(CMAKE_SCRIPT_MODE_FILE)
    file(GLOB_RECURSE files RELATIVE ${root} ${root}/*.cpp ${root}/*.h)
    list(FILTER files EXCLUDE REGEX "^app/|^main.cpp|/report/|^study/workers|^study/error/(comparison|decomposition|exponent|outcomes|stability|statistics|summary)")
    list(SORT files)
    foreach(file ${files})
        file(SHA256 ${root}/${file} hash)
        string(APPEND identity "${file} ${hash}\n")
    endforeach()
    string(SHA256 hash "${identity}")
    string(SUBSTRING ${hash} 0 16 hash)
    file(CONFIGURE OUTPUT ${header} CONTENT
"// SPDX-License-Identifier: MIT
// Names what this framework was built from; see cmake/sources.cmake.
#pragma once
#define LODESTIR_SOURCES \"${hash}\"
")
    return()
endif()

set(LODESTIR_SOURCES_HEADER ${PROJECT_BINARY_DIR}/include/lodestir/sources.h)
file(GLOB_RECURSE files CONFIGURE_DEPENDS framework/*.cpp framework/*.h)
add_custom_command(OUTPUT ${LODESTIR_SOURCES_HEADER}
    COMMAND ${CMAKE_COMMAND} -D root=${PROJECT_SOURCE_DIR}/framework -D header=${LODESTIR_SOURCES_HEADER} -P ${CMAKE_CURRENT_LIST_FILE}
    DEPENDS ${files} ${CMAKE_CURRENT_LIST_FILE} COMMENT "Naming the framework's sources" VERBATIM)
