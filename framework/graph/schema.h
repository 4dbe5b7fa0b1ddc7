// SPDX-License-Identifier: MIT
// What passes declare, told to people and programs: JSON facts, Markdown, and a JSON Schema for graph files.
#pragma once
#include <framework/core/json.h>
#include <framework/pass/pass.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

/// A pass type and one instance of it, to read the declaration from.
struct PassType {
    std::string type, doc;
    std::unique_ptr<Pass> pass;
};

/// Constructs a pass of the plugin; no GPU.
LODESTIR_API PassType makePassType(const std::string& type, const Plugin& plugin);

/// How large a port is that a pass makes: "frame", "0.5 of the frame", "like color", "4 per pixel", "1024 elements". Empty for inputs.
LODESTIR_API std::string sizeText(const Port& port);

/// {"type", "doc", "shader", "cadence", "canBeOff", "ports": [...], "parameters": [...]}
LODESTIR_API Json facts(const PassType& type);
/// The same for a terminal.
LODESTIR_API std::string text(const PassType& type);
/// A page with one section a pass.
LODESTIR_API std::string markdown(std::span<const PassType> types);
/// JSON Schema (draft 2020-12) of a graph file that may use these passes: editors complete and explain with it.
LODESTIR_API Json graphSchema(std::span<const PassType> types);

}  // namespace lodestir
