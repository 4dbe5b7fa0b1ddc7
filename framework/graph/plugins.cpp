// SPDX-License-Identifier: MIT
// Loads pass libraries with dlopen and looks up their passes. LODESTIR_ABI is given by the build.
#include <framework/graph/plugins.h>

#include <framework/graph/scene_node.h>

#include <fmt/format.h>
#include <lodestir/sources.h>

#include <algorithm>
#include <dlfcn.h>
#include <iterator>
#include <set>
#include <system_error>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

constexpr const char* entryPoint = "lodestirPlugins";

/// The library that a pass was compiled into.
Path libraryOf(const Plugin& plugin) {
    Dl_info info{};
    const bool found = ::dladdr(reinterpret_cast<const void*>(plugin.create), &info) != 0 && info.dli_fname;
    return found ? Path(info.dli_fname) : Path();
}

/// How to get a library that fits: ours, or one of an extra folder.
std::string rebuildHint(const std::string& folder, const Path& file) {
    std::error_code none;
    const bool ours = fs::equivalent(file.parent_path().parent_path().parent_path(), passFolder(), none);
    return ours ? "run: cmake --build build --target pass_" + folder : "build it again against the framework that it is to run with";
}

void checkAbi(const Plugin& plugin, const std::string& folder, const Path& file, const Where& where) {
    if (frameworkAbi() == plugin.abi) return;
    throw Error(where.file.empty() ? Where{file.string()} : where,
                "pass library \"" + folder + "\" was built against framework " + plugin.abi + ", this is " + std::string(frameworkAbi()),
                rebuildHint(folder, file));
}

}  // namespace

std::string_view frameworkAbi() { return LODESTIR_ABI; }

std::string_view frameworkSources() { return LODESTIR_SOURCES; }

PluginLibraries::PluginLibraries(std::vector<Path> extraFolders) {
    addBuiltIn("scene", scenePlugin());
    folders_.push_back(passFolder());
    for (Path& folder : extraFolders) {
        std::error_code none;
        if (!fs::is_directory(folder, none)) throw Error(Where{folder.string()}, "there is no such folder of passes");
        folders_.push_back(fs::absolute(folder));  // dlopen looks for a name without a slash elsewhere
    }
}

void PluginLibraries::addBuiltIn(const std::string& type, const Plugin& plugin) { builtIns_.insert_or_assign(type, plugin); }

Path PluginLibraries::fileOf(const std::string& folder, const Where& where) const {
    const Path name = Path(folder) / ("lib" + folder + ".so");
    std::error_code none;
    std::set<Path> found;
    const auto look = [&](const Path& file) {
        if (fs::is_regular_file(file, none)) found.insert(fs::weakly_canonical(file, none));
    };
    for (const Path& root : folders_) {
        look(root / name);
        for (const fs::directory_entry& family : fs::directory_iterator(root, none)) look(family.path() / name);
    }
    // Not the first of them: nobody could tell which runs.
    if (found.size() > 1)
        throw Error(where, "there are two passes \"" + folder + "\": " + found.begin()->string() + " and " + std::next(found.begin())->string(), "rename one");
    return found.empty() ? Path() : *found.begin();
}

std::vector<std::string> PluginLibraries::knownFolders() const {
    std::set<std::string> names;
    for (const auto& [type, plugin] : builtIns_) names.insert(type);
    for (const Path& root : folders_) {
        std::error_code none;
        const auto add = [&](const Path& folder) {
            const std::string name = folder.filename().string();
            if (fs::is_regular_file(folder / ("lib" + name + ".so"), none)) names.insert(name);
        };
        for (const fs::directory_entry& entry : fs::directory_iterator(root, none)) {
            add(entry.path());
            for (const fs::directory_entry& inner : fs::directory_iterator(entry.path(), none)) add(inner.path());
        }
    }
    return {names.begin(), names.end()};
}

const PluginLibraries::Library* PluginLibraries::library(const std::string& folder, const Where& where) {
    if (const auto known = libraries_.find(folder); known != libraries_.end()) return &known->second;
    const Path file = fileOf(folder, where);
    if (file.empty()) return nullptr;

    const Hash code = Hash().add(readBytes(file));
    // A missing symbol is an error now, with its name, and no library sees the symbols of another.
    void* handle = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        const char* reason = ::dlerror();
        throw Error(where, "pass library \"" + folder + "\" can't be loaded: " + (reason ? reason : "unknown reason"),
                    rebuildHint(folder, file));
    }
    using List = const Plugin* (*)();
    const auto list = reinterpret_cast<List>(::dlsym(handle, entryPoint));
    const Plugin* first = list ? list() : nullptr;
    if (!first) throw Error(where, "\"" + file.string() + "\" exports no pass", "end its .cpp with LODESTIR_PASS(...)");

    std::vector<const Plugin*> plugins;
    for (const Plugin* plugin = first; plugin; plugin = plugin->next) {
        checkAbi(*plugin, folder, file, where);  // before `next`, which another framework might keep elsewhere
        plugins.push_back(plugin);
    }
    std::ranges::reverse(plugins);  // each pass put itself before the others
    return &libraries_.emplace(folder, Library{std::move(plugins), code}).first->second;
}

const Plugin& PluginLibraries::find(const std::string& type, const Where& where) {
    if (const auto builtIn = builtIns_.find(type); builtIn != builtIns_.end()) return builtIn->second;
    const std::size_t dot = type.find('.');
    const std::string folder = type.substr(0, dot);
    const Library* loaded = library(folder, where);
    if (!loaded && folder.find('/') != folder.npos) throw Error(where, "no pass type \"" + type + "\"", "write the pass without its family");
    if (!loaded) throw Error(where, "no pass type \"" + type + "\"", didYouMean(folder, knownFolders()));

    const std::vector<const Plugin*>& plugins = loaded->plugins;
    std::vector<std::string> names;
    for (const Plugin* plugin : plugins) names.push_back(folder + "." + plugin->type);
    if (dot == type.npos) {
        if (plugins.size() == 1) return *plugins.front();
        throw Error(where, "\"" + type + "\" holds " + std::to_string(plugins.size()) + " passes",
                    fmt::format("name one: {}", fmt::join(names, ", ")));
    }
    const auto found = std::ranges::find(names, type);
    if (found == names.end()) throw Error(where, "no pass type \"" + type + "\"", didYouMean(type, names));
    return *plugins[static_cast<std::size_t>(found - names.begin())];
}

Hash PluginLibraries::codeOf(const std::string& type) const {
    if (builtIns_.contains(type)) return Hash().add(frameworkSources());
    return libraries_.at(type.substr(0, type.find('.'))).code;
}

std::vector<PluginLibraries::Entry> PluginLibraries::all(Problems& problems) {
    std::vector<Entry> entries;
    for (const std::string& name : knownFolders()) {
        if (const auto builtIn = builtIns_.find(name); builtIn != builtIns_.end()) {
            entries.push_back({name, &builtIn->second});
            continue;
        }
        try {
            const std::vector<const Plugin*>& plugins = library(name, {})->plugins;
            for (const Plugin* plugin : plugins) entries.push_back({plugins.size() == 1 ? name : name + "." + plugin->type, plugin});
        } catch (const Error& error) {
            problems.add(error);
        }
    }
    return entries;
}

Path shaderOf(const Plugin& plugin, std::string_view file) {
    const std::vector<Path> folders{libraryOf(plugin).parent_path(), Path(plugin.source).parent_path()};
    for (const Path& folder : folders) {
        std::error_code none;
        if (!folder.empty() && fs::is_regular_file(folder / file, none)) return folder / file;
    }
    throw Error("shader \"" + std::string(file) + "\" of pass \"" + plugin.type + "\" is neither in " + folders[0].string() + " nor in " +
                folders[1].string());
}

std::vector<Path> includeFolders(const Plugin& plugin) {
    const Path library = libraryOf(plugin).parent_path(), source = Path(plugin.source).parent_path();
    std::vector<Path> folders{library, source, shaderFolder()};
    for (const Path& own : {library, source}) folders.push_back(own.parent_path().parent_path());  // that of its family
    folders.push_back(familyFolder());
    return folders;
}

}  // namespace lodestir
