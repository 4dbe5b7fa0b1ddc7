# SPDX-License-Identifier: MIT
# Finds the libraries of the system (scripts/setup installs them) and gathers them as `lodestir_dependencies`. Nothing is downloaded.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Vulkan REQUIRED)
foreach(package OpenEXR Imath nlohmann_json glfw3 meshoptimizer glm CLI11 fmt spdlog glslang SPIRV-Tools-opt TinyGLTF GTest)
    find_package(${package} CONFIG REQUIRED QUIET)
endforeach()
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)
pkg_check_modules(stb REQUIRED IMPORTED_TARGET stb)
find_package(benchmark CONFIG QUIET)
find_package(embree 3 CONFIG QUIET)

# The one header that the oldest supported system lacks; scripts/setup keeps it in build/deps, which all build folders share.
find_path(VMA_INCLUDE_DIR vk_mem_alloc.h PATHS ${PROJECT_SOURCE_DIR}/build/deps/include PATH_SUFFIXES vma)
if(NOT VMA_INCLUDE_DIR)
    message(FATAL_ERROR "vk_mem_alloc.h is missing; run scripts/setup")
endif()
set(LODESTIR_SYSTEM_INCLUDES ${VMA_INCLUDE_DIR})

add_library(lodestir_dependencies INTERFACE)
target_link_libraries(lodestir_dependencies INTERFACE Vulkan::Vulkan OpenEXR::OpenEXR Imath::Imath nlohmann_json::nlohmann_json glfw
    meshoptimizer::meshoptimizer glm::glm CLI11::CLI11 fmt::fmt spdlog::spdlog glslang::SPIRV glslang::glslang
    glslang::glslang-default-resource-limits SPIRV-Tools-opt TinyGLTF::TinyGLTF PkgConfig::imgui PkgConfig::stb Threads::Threads ${CMAKE_DL_LIBS})
