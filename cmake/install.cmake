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
install(DIRECTORY scenes/ DESTINATION ${share}/scenes FILES_MATCHING PATTERN *.json PATTERN generate EXCLUDE)
install(DIRECTORY ${PROJECT_BINARY_DIR}/scenes/ DESTINATION ${share}/scenes FILES_MATCHING PATTERN *.glb)
install(PROGRAMS scripts/new_pass DESTINATION ${share}/scripts)

# Exactly the headers that LODESTIR_ABI is a hash of: what a pass can include it is refused for when it changes.
foreach(header ${LODESTIR_ABI_HEADERS})
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${header})
    get_filename_component(folder ${name} DIRECTORY)
    install(FILES ${header} DESTINATION include/lodestir/${folder})
endforeach()

# The package, once for the prefix and once for the build folder itself: passes can be built against either.
set(package_library [[${CMAKE_CURRENT_LIST_DIR}/../../liblodestir.so]])
set(package_include [[${CMAKE_CURRENT_LIST_DIR}/../../../include/lodestir]])
configure_file(cmake/lodestirConfig.cmake.in package/lodestirConfig.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lodestirConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/lodestirConfig.cmake ${PROJECT_BINARY_DIR}/lodestirConfigVersion.cmake DESTINATION lib/cmake/lodestir)
set(package_library ${PROJECT_BINARY_DIR}/liblodestir.so)
set(package_include ${PROJECT_SOURCE_DIR})
configure_file(cmake/lodestirConfig.cmake.in lodestirConfig.cmake @ONLY)
