// SPDX-License-Identifier: MIT
// Where things lie: the build and source trees when the library runs from the build, else the install prefix; and the cache.
// LODESTIR_SOURCE_DIR and LODESTIR_BUILD_DIR are given by the build.
#include <framework/core/error.h>
#include <framework/core/files.h>

#include <cstdlib>
#include <dlfcn.h>
#include <system_error>
#include <unistd.h>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

/// An environment variable, empty when it isn't set.
Path environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? Path(value) : Path();
}

bool isFolder(const Path& path) {
    std::error_code none;
    return fs::is_directory(path, none);
}

/// The folder of the shared library (or of the executable) that holds this function.
Path libraryFolder() {
    std::error_code none;
    Dl_info info{};
    // For the executable itself dladdr repeats argv[0], which may be relative to a folder we have left.
    const bool found = ::dladdr(reinterpret_cast<const void*>(&libraryFolder), &info) != 0 && info.dli_fname && info.dli_fname[0] == '/';
    return fs::weakly_canonical(found ? Path(info.dli_fname) : fs::read_symlink("/proc/self/exe", none), none).parent_path();
}

/// An installed program must not pick up the tree it was built in, though that may still exist, and the prefix may even lie inside it.
/// Tests are in a folder of their own, and hold the framework.
bool runsFromBuild() {
    std::error_code none;
    const Path build = fs::weakly_canonical(LODESTIR_BUILD_DIR, none), library = libraryFolder();
    return library == build || library == build / "tests";
}

/// share/lodestir/<name> of the install prefix. The library lies in <prefix>/lib, /bin or /lib/<architecture>.
Path shared(const char* name) {
    const Path guess = (libraryFolder() / "../share/lodestir" / name).lexically_normal();
    const Path deeper = (libraryFolder() / "../../share/lodestir" / name).lexically_normal();
    return !isFolder(guess) && isFolder(deeper) ? deeper : guess;
}

bool canUse(const Path& folder) {
    std::error_code reason;
    fs::create_directories(folder, reason);
    return !reason && ::access(folder.c_str(), W_OK) == 0;
}

}  // namespace

Path shaderFolder() {
    if (const Path chosen = environment("LODESTIR_SHADERS"); !chosen.empty()) return chosen;
    const Path source = Path(LODESTIR_SOURCE_DIR) / "framework/shaders";
    return runsFromBuild() && isFolder(source) ? source : shared("shaders");
}

Path passFolder() {
    const Path build = Path(LODESTIR_BUILD_DIR) / "passes";
    return runsFromBuild() && isFolder(build) ? build : libraryFolder() / "lodestir/passes";
}

Path familyFolder() {
    const Path source = Path(LODESTIR_SOURCE_DIR) / "passes";
    return runsFromBuild() && isFolder(source) ? source : passFolder();
}

Path sceneFolder() {
    const Path build = Path(LODESTIR_BUILD_DIR) / "scenes";
    return runsFromBuild() && isFolder(build) ? build : shared("scenes");
}

Path graphFolder() {
    const Path source = Path(LODESTIR_SOURCE_DIR) / "graphs";
    return runsFromBuild() && isFolder(source) ? source : shared("graphs");
}

Path cacheFolder(std::string_view kind) {
    if (const Path chosen = environment("LODESTIR_CACHE"); !chosen.empty()) {
        const Path folder = chosen / kind;
        if (!canUse(folder)) throw Error(Where{folder.string()}, "the cache folder cannot be written", "check LODESTIR_CACHE");
        return folder;
    }
    const Path xdg = environment("XDG_CACHE_HOME"), home = environment("HOME");
    if (xdg.is_absolute() && canUse(xdg / "lodestir" / kind)) return xdg / "lodestir" / kind;
    if (home.is_absolute() && canUse(home / ".cache/lodestir" / kind)) return home / ".cache/lodestir" / kind;
    // Nobody else's files: each user has a folder of their own.
    const Path last = fs::temp_directory_path() / ("lodestir-" + std::to_string(::getuid())) / kind;
    canUse(last);
    return last;
}

}  // namespace lodestir
