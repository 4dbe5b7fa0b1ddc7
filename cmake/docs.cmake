# SPDX-License-Identifier: MIT
# build/docs/passes.md: the reference of all passes, made of their declarations.
set(libraries ${pass_folders})
list(TRANSFORM libraries REPLACE ".*/" "pass_")
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
add_custom_command(OUTPUT docs/passes.md COMMAND lodestir passes --markdown > docs/passes.md.new
    COMMAND ${CMAKE_COMMAND} -E rename docs/passes.md.new docs/passes.md
    DEPENDS lodestir framework ${libraries} COMMENT "Writing docs/passes.md" VERBATIM)
add_custom_target(docs ALL DEPENDS docs/passes.md)
