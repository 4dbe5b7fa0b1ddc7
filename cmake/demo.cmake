# SPDX-License-Identifier: MIT
# The target `demo`: what scripts/demo needs for its image. The program, and of passes and scenes only those that its graph names.
set(file ${PROJECT_SOURCE_DIR}/graphs/path_tracer.json)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
file(READ ${file} graph)
string(JSON scene GET "${graph}" scene)
get_filename_component(scene ${scene} NAME_WE)
add_custom_target(demo DEPENDS lodestir scene_${scene} scene_furnace)  # the furnace is what `devices --test` renders

string(JSON nodes GET "${graph}" passes)
string(JSON count LENGTH "${nodes}")
math(EXPR last "${count} - 1")
foreach(i RANGE ${last})
    string(JSON node MEMBER "${nodes}" ${i})
    string(JSON type GET "${nodes}" ${node} type)
    add_dependencies(demo pass_${type})
endforeach()
