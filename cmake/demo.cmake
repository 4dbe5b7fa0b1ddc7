# SPDX-License-Identifier: MIT
# The target `demo`: what scripts/demo needs for its image and its study. The program, and of passes and scenes only those that they name.
add_custom_target(demo DEPENDS lodestir scene_furnace scene_cornell_glossy)  # the furnace is what `devices --test` renders, the box what the study does
foreach(name path_tracer restir_pt)
    set(file ${PROJECT_SOURCE_DIR}/graphs/${name}.json)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} graph)
    string(JSON scene GET "${graph}" scene)
    get_filename_component(scene ${scene} NAME_WE)
    add_dependencies(demo scene_${scene})

    string(JSON nodes GET "${graph}" passes)
    string(JSON count LENGTH "${nodes}")
    math(EXPR last "${count} - 1")
    foreach(i RANGE ${last})
        string(JSON node MEMBER "${nodes}" ${i})
        string(JSON type GET "${nodes}" ${node} type)
        add_dependencies(demo pass_${type})
    endforeach()
endforeach()
