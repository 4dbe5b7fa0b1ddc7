# SPDX-License-Identifier: MIT
# `cmake --install BUILD --prefix PREFIX`: a program that finds what it needs from its own place, so that the prefix may be moved, and what
# passes outside of this tree are built with: headers, and find_package(lodestir CONFIG).
include(CMakePackageConfigHelpers)
set(share share/lodestir)

install(TARGETS lodestir framework RUNTIME DESTINATION bin LIBRARY DESTINATION lib)
set_target_properties(lodestir PROPERTIES INSTALL_RPATH "\$ORIGIN/../lib")
foreach(folder ${pass_folders})
    get_filename_component(name ${folder} NAME)
    install(TARGETS pass_${name} LIBRARY DESTINATION lib/lodestir/${folder})
    string(REGEX REPLACE "[^/]+" ".." up ${folder})
    set_target_properties(pass_${name} PROPERTIES INSTALL_RPATH "\$ORIGIN/../${up}")
endforeach()
install(DIRECTORY passes DESTINATION lib/lodestir PATTERN *.cpp EXCLUDE PATTERN *.test.comp EXCLUDE)
# The examples beside the passes are as deep below the scenes' folder as they are here below the root, but two folders more.
install(CODE [[
    file(GLOB_RECURSE graphs "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/lib/lodestir/passes/*.json")
    foreach(graph ${graphs})
        file(READ ${graph} text)
        string(REGEX REPLACE "\"((\\.\\./)+)scenes/" "\"../../\\1share/lodestir/scenes/" text "${text}")
        file(WRITE ${graph} "${text}")
    endforeach()]])

install(DIRECTORY framework/shaders DESTINATION ${share} PATTERN *.test.comp EXCLUDE)
install(DIRECTORY graphs studies docs DESTINATION ${share})
install(FILES ${PROJECT_BINARY_DIR}/docs/passes.md DESTINATION ${share}/docs)
install(DIRECTORY scenes/ DESTINATION ${share}/scenes FILES_MATCHING PATTERN *.json PATTERN generate EXCLUDE)
install(DIRECTORY ${PROJECT_BINARY_DIR}/scenes/ DESTINATION ${share}/scenes FILES_MATCHING PATTERN *.glb)
install(PROGRAMS scripts/new_pass DESTINATION ${share}/scripts)
install(DIRECTORY scripts/report scripts/slurm DESTINATION ${share}/scripts USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)

# The same tree as build/api: exactly the headers that LODESTIR_ABI is a hash of (what a pass can include it is refused for when it changes), and
# the families of passes.
foreach(name ${LODESTIR_API_HEADERS})
    get_filename_component(folder ${name} DIRECTORY)
    install(FILES ${name} DESTINATION include/lodestir/${folder})
endforeach()
install(FILES ${LODESTIR_API_DIR}/lodestir/abi.h DESTINATION include/lodestir/lodestir)
install(CODE [[
    file(REMOVE "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/include/lodestir/passes")
    file(CREATE_LINK ../../lib/lodestir/passes "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/include/lodestir/passes" SYMBOLIC)]])

# The package, once for the prefix and once for the build folder itself: passes can be built against either.
set(package_library [[${CMAKE_CURRENT_LIST_DIR}/../../liblodestir.so]])
set(package_include [[${CMAKE_CURRENT_LIST_DIR}/../../../include/lodestir]])
configure_file(cmake/lodestirConfig.cmake.in package/lodestirConfig.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lodestirConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/lodestirConfig.cmake ${PROJECT_BINARY_DIR}/lodestirConfigVersion.cmake DESTINATION lib/cmake/lodestir)
set(package_library ${PROJECT_BINARY_DIR}/liblodestir.so)
set(package_include ${LODESTIR_API_DIR})
configure_file(cmake/lodestirConfig.cmake.in lodestirConfig.cmake @ONLY)
