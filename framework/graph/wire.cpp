// SPDX-License-Identifier: MIT
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {

bool Wire::fits(const Wire& other) const {
    if (bundle || other.bundle) return bundle && other.bundle && bundle->type == other.bundle->type;
    return port().type.isSame(other.port().type);
}

std::string Wire::membersText() const {
    std::vector<std::string> members;
    for (int i = 0; bundle && i < count; ++i) members.push_back(fmt::format("{} ({})", bundle->members[std::size_t(i)].inBundle, port(i).type.text()));
    return fmt::format("{}", fmt::join(members, " and "));
}

std::vector<Wire> wiresOf(const Pass& pass) {
    std::vector<Wire> wires;
    for (int i = 0; i < int(pass.ports.size()); i += wires.back().count) wires.push_back(wireOf(pass, i));
    return wires;
}

Wire wireOf(const Pass& pass, int port) {
    const BundlePort* bundle = pass.ports[std::size_t(port)]->bundle;
    if (!bundle) return {&pass, port};
    while (pass.ports[std::size_t(port)] != &bundle->members.front()) --port;
    return {&pass, port, int(bundle->members.size()), bundle};
}

std::vector<Wire> membersOf(const Wire& wire) {
    std::vector<Wire> members;
    for (int i = 0; wire.bundle && i < wire.count; ++i) members.push_back({wire.pass, wire.first + i});
    return members;
}

std::vector<std::string> namesOf(const std::vector<Wire>& wires) {
    std::vector<std::string> names;
    for (const Wire& wire : wires)
        if (std::ranges::find(names, wire.name()) == names.end()) names.emplace_back(wire.name());  // what comes in may go out by the same name
    return names;
}

}  // namespace lodestir
