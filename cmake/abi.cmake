# SPDX-License-Identifier: MIT
# The API of passes: the headers reachable from framework/pass and the structs shared with shaders. build/api is a tree of links to exactly
# these, and to the families of passes: all that a pass is compiled with. LODESTIR_ABI names what a pass library and the framework must agree
# on: the API, the compiler and its flags. It is computed at configure time, and again when one of them changes.

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
file(GLOB_RECURSE roots CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/framework/pass/*.h ${PROJECT_SOURCE_DIR}/framework/shaders/*.h)
foreach(header ${roots})
    lodestir_gather_headers(${header} headers)
endforeach()
list(SORT headers)
set(LODESTIR_API_HEADERS)  # relative to the root
foreach(header ${headers})
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${header})
    list(APPEND LODESTIR_API_HEADERS ${name})
endforeach()

string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
set(identity "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_CXX_STANDARD} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${LODESTIR_SANITIZE}")
foreach(name ${LODESTIR_API_HEADERS})
    file(SHA256 ${PROJECT_SOURCE_DIR}/${name} hash)
    string(APPEND identity "\n${name} ${hash}")
endforeach()
string(SHA256 hash "${identity}")
string(SUBSTRING ${hash} 0 16 LODESTIR_ABI)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${headers})

set(LODESTIR_API_DIR ${PROJECT_BINARY_DIR}/api)
file(REMOVE_RECURSE ${LODESTIR_API_DIR}/framework)
foreach(name ${LODESTIR_API_HEADERS})
    get_filename_component(folder ${LODESTIR_API_DIR}/${name} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${name} ${LODESTIR_API_DIR}/${name} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/passes ${LODESTIR_API_DIR}/passes SYMBOLIC)
# What names it, for passes that are built by hand: g++ ... -include lodestir/abi.h
file(CONFIGURE OUTPUT ${LODESTIR_API_DIR}/lodestir/abi.h
    CONTENT "// Names what this framework was built from; see cmake/abi.cmake.\n#pragma once\n#define LODESTIR_ABI \"@LODESTIR_ABI@\"\n" @ONLY)
