// SPDX-License-Identifier: MIT
// The names that a graph wires: of ports and of bundles of them.
#pragma once
#include <framework/pass/pass.h>

#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

inline bool isInput(const Port& port) { return port.isInput(); }
/// Can another pass read it? (Scratch can only be shown or dumped.)
inline bool isMade(const Port& port) { return port.role == Port::Role::out || port.role == Port::Role::state; }

/// What one name wires: a port of a pass, or a bundle's, which follow each other in Pass::ports.
struct Wire {
    const Pass* pass = nullptr;
    int first = -1;
    int count = 1;
    const BundlePort* bundle = nullptr;  ///< null: a single port, be it a bundle's member

    const Port& port(int i = 0) const { return *pass->ports[std::size_t(first + i)]; }
    std::string_view name() const { return bundle ? bundle->name : port().name; }  ///< as "pass.name" has it
    std::string typeText() const { return bundle ? std::string(bundle->type) : port().type.text(); }
    std::string_view doc() const { return bundle ? bundle->doc : port().doc; }
    std::string membersText() const;  ///< "reservoirs (Buffer<Reservoir>) and samples (Buffer<SampleHit>)"; of a single port nothing
    /// Equal types, as far as their names go.
    bool fits(const Wire& other) const;
};

/// The wires of a pass in order of declaration: bundles whole.
std::vector<Wire> wiresOf(const Pass& pass);
template <class P> std::vector<Wire> wiresOf(const Pass& pass, const P& which) {
    std::vector<Wire> wires = wiresOf(pass);
    std::erase_if(wires, [&](const Wire& wire) { return !which(wire.port()); });
    return wires;
}
/// Of those, the one that port `port` belongs to.
Wire wireOf(const Pass& pass, int port);
/// The members of a bundle, each by itself; of a single port none.
std::vector<Wire> membersOf(const Wire& wire);

std::vector<std::string> namesOf(const std::vector<Wire>& wires);

}  // namespace lodestir
