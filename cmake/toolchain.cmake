# SPDX-License-Identifier: MIT
# Compiler cache and linker: the fastest ones this machine has.
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # Precompiled headers hold time stamps that ccache has to be told not to mind; for it to look into them, each compiler has a flag of its own.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE_PROGRAM})
    add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=mold LODESTIR_HAS_MOLD)
check_linker_flag(CXX -fuse-ld=lld LODESTIR_HAS_LLD)
if(LODESTIR_HAS_MOLD)
    add_link_options(-fuse-ld=mold)
elseif(LODESTIR_HAS_LLD)
    add_link_options(-fuse-ld=lld)
endif()
