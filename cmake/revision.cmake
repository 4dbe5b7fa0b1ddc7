# SPDX-License-Identifier: MIT
# Writes <lodestir/revision.h>: the commit this tree is at, for the provenance in images and reports.
set(revision unknown)
find_package(Git QUIET)
if(Git_FOUND)
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${PROJECT_SOURCE_DIR} rev-parse --short=12 HEAD
        OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
        set(revision ${output})
        execute_process(COMMAND ${GIT_EXECUTABLE} -C ${PROJECT_SOURCE_DIR} rev-parse --git-path logs/HEAD
            OUTPUT_VARIABLE moves OUTPUT_STRIP_TRAILING_WHITESPACE)
        get_filename_component(moves ${moves} ABSOLUTE BASE_DIR ${PROJECT_SOURCE_DIR})
        if(EXISTS ${moves})
            set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${moves})
        endif()
    endif()
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/lodestir/revision.h CONTENT
"// SPDX-License-Identifier: MIT
// The commit this was built from; written at configure time.
#pragma once
#define LODESTIR_REVISION \"${revision}\"
")
