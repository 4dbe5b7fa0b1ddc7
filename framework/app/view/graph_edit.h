// SPDX-License-Identifier: MIT
// What an edit of a graph writes: merge patches (RFC 7396) of its JSON, and which edits there are. Pure functions of a graph that was built; no window.
#pragma once
#include <framework/graph/schema.h>
#include <framework/graph/source.h>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// What an input is wired to as the graph says it, before passes that are off are left out.
struct Feed {
    int node = -1;
    Wire output;  ///< a whole bundle, or one member of it
    bool prev = false;
    bool written = false;  ///< false: the graph binds it by itself
};
LODESTIR_API std::optional<Feed> feedOf(const Graph& graph, int node, const Wire& input);

/// An output that fits an input.
struct Offer {
    int node = -1, port = -1;  ///< the port, or a bundle's first
    std::string text;          ///< as the graph file names it there: "initial.paths", "spatial.paths@prev"
};
/// Last frame's value is offered of a pass that comes after, to an input called "...Prev", and to one that took last frame's before.
LODESTIR_API std::vector<Offer> offersFor(const Graph& graph, int node, const Wire& input);

/// Required inputs of a new pass for which the graph has several outputs, and what they are.
struct Question {
    std::string input;
    std::vector<std::string> answers;
};
LODESTIR_API std::vector<Question> questionsOf(const Graph& graph, const PassType& type);

LODESTIR_API Json turnPatch(const std::string& pass, bool off);
/// `from`: what the graph file says there; empty: nothing.
LODESTIR_API Json wirePatch(const std::string& pass, const std::string& input, const std::string& from);
/// Without the pass: who took something of it takes what it handed through, or nothing where that will do. Error where neither is possible.
LODESTIR_API Json removalPatch(const Graph& graph, int node);
/// With another type in the pass's place, fed with what it was fed with. Parameters that both have alike stay as they are set. Nothing where an input would
/// stay unwired, or somebody uses an output that has no counterpart.
LODESTIR_API std::optional<Json> swapPatch(const Graph& graph, int node, const PassType& type);
/// With one more pass, at the end. Its inputs take the only output that fits, or what `answers` says.
LODESTIR_API Json additionPatch(const Graph& graph, const PassType& type, const std::map<std::string, std::string>& answers = {});

/// A pass that takes a World and hands it on changed.
struct WorldPass {
    std::string type;
    bool ownPrevious = false;  ///< it takes its own World of last frame as "worldPrev"
    Json set = Json::object();
};
/// With such a pass straight behind the scene, before all else: who took the scene's World, last frame's included, takes the new pass's. `name`: of the
/// new pass, which no other has.
LODESTIR_API Json worldPatch(const Graph& graph, const std::string& name, const WorldPass& pass);
/// Type "folder" or "folder.Struct" as the name of a pass that no other has.
LODESTIR_API std::string nameFor(const Graph& graph, const std::string& type);

}  // namespace lodestir
