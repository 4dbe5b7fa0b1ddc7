// SPDX-License-Identifier: MIT
// A pass's declaration for people: on a terminal and as Markdown.
#include <framework/graph/graph.h>
#include <framework/graph/schema.h>
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lodestir {
namespace {

using Row = std::vector<std::string>;

std::string roleText(const Port& port) {
    static constexpr std::array names{"in", "out", "state", "scratch"};
    return std::string(port.optional ? "optional " : "") + names[static_cast<std::size_t>(port.role)];
}

std::string shapeText(const Port& port) {
    const std::string size = sizeText(port);
    if (port.isInput() || port.type.kind != PortType::Kind::image) return size;
    return fmt::format("{}, {}", factsOf(port.format).name, size);
}

std::vector<Row> portRows(const PassType& type) {
    std::vector<Row> rows;
    for (const Wire& wire : wiresOf(*type.pass))
        rows.push_back({std::string(wire.name()), roleText(wire.port()), wire.typeText(), shapeText(wire.port()), std::string(wire.doc())});
    return rows;
}

std::vector<Row> parameterRows(const PassType& type) {
    std::vector<Row> rows;
    for (const Parameter* p : type.pass->parameters) {
        rows.push_back({std::string(p->name), p->typeText() + (p->constant ? ", constant" : ""), writeValue(*p, p->initial).dump(-1),
                        std::string(p->doc)});
    }
    return rows;
}

/// Columns as wide as their widest cell, but for the last.
std::string columns(const std::vector<Row>& rows) {
    std::string out;
    for (const Row& row : rows) {
        out += " ";
        for (std::size_t c = 0; c < row.size(); ++c) {
            std::size_t width = 0;
            for (const Row& other : rows) width = std::max(width, c + 1 < row.size() ? other[c].size() : 0);
            out += fmt::format(" {:{}} ", row[c], width);
        }
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

std::string table(const Row& heads, const std::vector<Row>& rows) {
    if (rows.empty()) return {};
    std::string out = fmt::format("\n| {} |\n|", fmt::join(heads, " | "));
    for (std::size_t c = 0; c < heads.size(); ++c) out += "---|";
    out += '\n';
    for (const Row& row : rows) {
        out += '|';
        for (std::string cell : row) {
            for (std::size_t at = 0; (at = cell.find('|', at)) != cell.npos; at += 2) cell.insert(at, "\\");
            out += ' ' + cell + " |";
        }
        out += '\n';
    }
    return out;
}

/// One of each type.
std::vector<Wire> bundlesOf(const Pass& pass) {
    std::vector<Wire> bundles;
    for (const Wire& wire : wiresOf(pass)) {
        if (wire.bundle && std::ranges::find(bundles, wire.typeText(), &Wire::typeText) == bundles.end()) bundles.push_back(wire);
    }
    return bundles;
}

std::string remarks(const PassType& type) {
    std::string out;
    if (type.pass->cadence == Cadence::onChange) out += "Runs when an input or a parameter changed. ";
    if (type.pass->restartOnChange) out += "Starts again when any parameter of the graph changes. ";
    for (const Pass::Bypass& bypass : type.pass->bypasses) {
        const BundlePort* bundle = bypass.in->bundle;
        if (!bundle || bypass.in == &bundle->members.front()) out += fmt::format("Off: `{}` is `{}`. ", bypass.out->wire(), bypass.in->wire());
    }
    for (const Pass::Bypass& over : type.pass->overwrites) {
        const BundlePort* bundle = over.in->bundle;
        if (bundle && over.in != &bundle->members.front()) continue;
        out += fmt::format("Makes `{}` in the memory of `{}` where nothing else needs that. ", over.out->wire(), over.in->wire());
    }
    for (const Wire& bundle : bundlesOf(*type.pass)) out += fmt::format("{} is {}. ", bundle.typeText(), bundle.membersText());
    if (!out.empty()) out.pop_back();
    return out;
}

}  // namespace

std::string text(const PassType& type) {
    std::string out = fmt::format("{}: {}\n", type.type, type.doc);
    if (const std::string more = remarks(type); !more.empty()) out += "  " + more + "\n";
    if (!type.pass->ports.empty()) out += "ports\n" + columns(portRows(type));
    if (!type.pass->parameters.empty()) out += "parameters\n" + columns(parameterRows(type));
    return out;
}

std::string markdown(std::span<const PassType> types) {
    std::string out = "# Passes\n\nWritten by `lodestir passes --markdown` from what each pass declares.\n";
    for (const PassType& type : types) {
        out += fmt::format("\n## {}\n\n{}\n", type.type, type.doc);
        if (const std::string more = remarks(type); !more.empty()) out += "\n" + more + "\n";
        out += table({"port", "role", "type", "shape", "holds"}, portRows(type));
        out += table({"parameter", "values", "default", "means"}, parameterRows(type));
    }
    return out;
}

}  // namespace lodestir
