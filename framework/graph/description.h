// SPDX-License-Identifier: MIT
// A graph file as it was written, variants and command-line overrides applied: names and values with their places. No GPU, no plugins.
#pragma once
#include <framework/core/files.h>
#include <framework/core/json.h>

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// "in": { "<port>": "<fromNode>.<fromPort>@prev" }
struct EdgeDescription {
    std::string port;
    std::string fromNode, fromPort;  ///< fromPort is empty where the file names the pass alone
    bool prev = false;
    Where where;      ///< of the value
    Where portWhere;  ///< of the key
};

/// A parameter of a pass ("bounces"), or of a pass of a graph ("trace.bounces"), and what it is set to; value.keyWhere() is the place of the name.
struct Setting {
    std::string name;
    Json value;
};

struct NodeDescription {
    std::string name, type;
    std::vector<EdgeDescription> edges;
    std::vector<Setting> settings;
    bool off = false;
    Where where;  ///< of the name
    Where typeWhere;
    Where offWhere;
};

struct Description {
    Path file;
    std::string about;
    Path scene;  ///< resolved relative to the graph file; empty: none named
    Where sceneWhere;
    glm::uvec2 size{960, 540};  ///< pixels
    int count = 1;              ///< frames
    std::uint32_t seed = 1;
    std::vector<NodeDescription> nodes;  ///< in file order
    std::string showNode, showPort;      ///< showPort is empty where the file names the pass alone
    Where showWhere;
    std::vector<std::string> variants;  ///< names, in file order
    Json source;                        ///< the file after the variant's merge patch and all overrides, without "variants"
};

/// What the command line (or a study) changes in a graph. Applied in this order: variant, patches, the other fields, `set`.
struct GraphOptions {
    std::optional<Path> scene;  ///< relative to the working folder
    std::optional<int> frames;
    std::optional<glm::uvec2> size;
    std::optional<std::uint32_t> seed;
    std::vector<Setting> set;   ///< "pass.parameter", "frame.seed", ...; what is wrong with one is said at the place of its value
    std::optional<std::string> variant;  ///< several joined by " + " are applied one after the other
    Where variantWhere = {};             ///< of that name; empty: it is told at the graph file
    std::optional<std::string> show;  ///< "pass" or "pass.port"
    std::vector<Json> patches = {};   ///< merged into the graph (RFC 7396) behind the variant, one after the other
};

/// Largest width and height of a frame, pixels.
inline constexpr int maxFrameSize = 16384;

/// Reads a graph file. Throws Error with everything that is wrong with its form.
LODESTIR_API Description loadDescription(const Path& file, const GraphOptions& options = {});
/// The same for a graph that is already in memory; `file` gives the folder that a relative scene path starts from.
LODESTIR_API Description readDescription(Json source, const Path& file, const GraphOptions& options = {});

/// "pass.parameter=value" as the command line has it; the value is JSON, else text (a size also 1280x720). Error when there is no "=" or no ".".
LODESTIR_API Setting readSetting(const std::string& text);

}  // namespace lodestir
