# SPDX-License-Identifier: MIT
# LODESTIR_ABI names all that a pass library and the framework must agree on: the headers reachable from framework/pass/pass.h,
# the structs shared with shaders, the compiler and its flags. It is computed at configure time, and again when one of them changes.

# Appends to the list `found` the header and everything of ours that it includes.
function(lodestir_gather_headers header found)
    set(headers ${${found}})
    if(header IN_LIST headers OR NOT EXISTS ${header})
        return()
    endif()
    list(APPEND headers ${header})
    get_filename_component(folder ${header} DIRECTORY)
    file(STRINGS ${header} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"][^<>\"]+[>\"]")
    foreach(line ${lines})
        string(REGEX REPLACE ".*[<\"]([^<>\"]+)[>\"].*" "\\1" name "${line}")
        foreach(root ${folder} ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/framework/shaders)
            if(EXISTS ${root}/${name})
                get_filename_component(path ${root}/${name} ABSOLUTE)
                lodestir_gather_headers(${path} headers)
                break()
            endif()
        endforeach()
    endforeach()
    set(${found} ${headers} PARENT_SCOPE)
endfunction()

set(headers)
lodestir_gather_headers(${PROJECT_SOURCE_DIR}/framework/pass/pass.h headers)
file(GLOB_RECURSE shared CONFIGURE_DEPENDS framework/shaders/*.h)
foreach(header ${shared})
    lodestir_gather_headers(${header} headers)
endforeach()
list(SORT headers)
set(LODESTIR_ABI_HEADERS ${headers})

string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
set(identity "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_STANDARD} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${LODESTIR_SANITIZE}")
foreach(header ${headers})
    file(SHA256 ${header} hash)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${header})
    string(APPEND identity "\n${name} ${hash}")
endforeach()
string(SHA256 hash "${identity}")
string(SUBSTRING ${hash} 0 16 LODESTIR_ABI)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})

# For passes that are built by hand, outside this tree: g++ ... -include <build>/include/lodestir/abi.h
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/lodestir/abi.h
    CONTENT "// Names what this framework was built from; see cmake/abi.cmake.\n#pragma once\n#define LODESTIR_ABI \"@LODESTIR_ABI@\"\n" @ONLY)
