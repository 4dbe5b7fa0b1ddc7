# SPDX-License-Identifier: MIT
# scenes/generate/scenes/NAME.cpp -> build/scenes/NAME.glb, the target scene_NAME. Each scene is a program of its own and made by itself, so that an
# edit makes one of them anew; what they share is scenes/generate/kit. Scenes that are large are made when their target is asked for, and else not.
file(GLOB sources CONFIGURE_DEPENDS scenes/generate/kit/*.cpp)
add_library(scene_kit STATIC ${sources})
target_link_libraries(scene_kit PUBLIC lodestir_options lodestir_dependencies)
target_include_directories(scene_kit PUBLIC scenes/generate)
set_target_properties(scene_kit PROPERTIES POSITION_INDEPENDENT_CODE OFF)  # as the programs: they share its precompiled header
target_precompile_headers(scene_kit PRIVATE <filesystem> <functional> <string> <vector> <glm/glm.hpp> <glm/gtc/quaternion.hpp>)

# What makes levels of detail. That the program was linked says nothing: the library is not linked into it.
file(GLOB lod_sources CONFIGURE_DEPENDS framework/scene/lod/*)

add_custom_target(scenes ALL)
file(GLOB sources CONFIGURE_DEPENDS scenes/generate/scenes/*.cpp)
foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    file(STRINGS ${source} large REGEX "^LODESTIR_LARGE_SCENE")
    if(large)
        set(asked EXCLUDE_FROM_ALL)
    else()
        set(asked)
    endif()
    add_executable(generate_${name} ${asked} ${source})
    target_link_libraries(generate_${name} PRIVATE scene_kit)
    target_precompile_headers(generate_${name} REUSE_FROM scene_kit)
    set_target_properties(generate_${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/generate)

    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} levels REGEX "^LODESTIR_SCENE\\(.*\".*\"\\)")
    set(made scenes/${name}.glb)
    if(levels)
        string(REGEX REPLACE ".*\"(.*)\".*" "\\1" levels ${levels})
        separate_arguments(levels)
        set(made generate/${name}.glb)  # the finest level alone
        add_custom_command(OUTPUT scenes/${name}.glb COMMAND lodestir lod ${made} --out scenes/${name}.glb --force ${levels}
            DEPENDS ${made} lodestir ${lod_sources} COMMENT "Adding levels to scene ${name}" VERBATIM)
    endif()
    add_custom_command(OUTPUT ${made} COMMAND generate_${name} ${made} DEPENDS generate_${name} COMMENT "Generating scene ${name}" VERBATIM)
    add_custom_target(scene_${name} DEPENDS scenes/${name}.glb)
    if(NOT large)
        add_dependencies(scenes scene_${name})
    endif()
endforeach()
