// SPDX-License-Identifier: MIT
// Finds pass libraries by the names of their folders and loads them when a type is first named.
#pragma once
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/pass/pass.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// Pass types are named "folder" where the folder's library holds one pass, else "folder.Struct", whatever family the folder is in. The library
/// of folder x is x/libx.so or FAMILY/x/libx.so in passFolder() or in an extra folder. Loaded libraries stay mapped until the
/// process ends.
class LODESTIR_API PluginLibraries {
public:
    /// Knows the built-in pass "scene".
    explicit PluginLibraries(std::vector<Path> extraFolders = {});

    /// A pass that is part of the framework (or of a test); hides a folder of the same name.
    void addBuiltIn(const std::string& type, const Plugin& plugin);
    /// The plugin of a type, loading its library. Error at `where`: no such folder or struct (with a guess), not loadable, or built
    /// against another framework.
    const Plugin& find(const std::string& type, const Where& where = {});
    /// Names what the code of a type that was found is built to: the bytes of its library, as they were when it was loaded; of a built-in pass the
    /// framework's sources.
    Hash codeOf(const std::string& type) const;

    struct Entry {
        std::string type;
        const Plugin* plugin;
    };
    /// Every pass of every folder, sorted by type, built-in ones included; what cannot be loaded goes to `problems`.
    std::vector<Entry> all(Problems& problems);
    /// The folders that are searched.
    const std::vector<Path>& folders() const { return folders_; }

private:
    struct Library {
        std::vector<const Plugin*> plugins;  ///< in order of declaration
        Hash code;
    };
    /// The library of one folder, loaded when first asked for; null: there is none.
    const Library* library(const std::string& folder, const Where& where);
    Path fileOf(const std::string& folder, const Where& where) const;  ///< empty: there is none; Error at `where`: there are two
    std::vector<std::string> knownFolders() const;                     ///< sorted, with the built-in types

    std::vector<Path> folders_;
    std::map<std::string, Plugin> builtIns_;
    std::map<std::string, Library> libraries_;
};

/// Names the headers, the compiler and the flags that this framework was built with.
LODESTIR_API std::string_view frameworkAbi();
/// Names the sources that this framework was built from, but for those of commands, windows and reports.
LODESTIR_API std::string_view frameworkSources();
/// A file of a pass's folder: beside its library first, then beside its source.
LODESTIR_API Path shaderOf(const Plugin& plugin, std::string_view file);
/// Folders in which the includes of a pass's shaders and struct headers are looked up: beside the library, beside the source, the
/// framework's shaders, and the folders of its own family and of all of ours, in which a module is "family/module.glsl".
LODESTIR_API std::vector<Path> includeFolders(const Plugin& plugin);

}  // namespace lodestir
