// SPDX-License-Identifier: MIT
// What every pass does unless it says otherwise.
#include <framework/core/error.h>
#include <framework/graph/pass.h>

#include <algorithm>

namespace lodestir {

Pass::Pass() = default;
Pass::~Pass() = default;

void Pass::execute(Frame& frame) {
    const auto isMade = [](const Port* port) { return port->role == Port::Role::out || port->role == Port::Role::state; };
    const auto first = std::ranges::find_if(ports, isMade);
    if (first == ports.end() || (*first)->type.kind == PortType::Kind::handle) {
        throw Error("a pass whose first output is no image and no buffer has nothing to dispatch \"" + std::string(shader) + "\" over",
                    "override execute()");
    }
    const Port& port = **first;
    frame.dispatch(shader, port.type.kind == PortType::Kind::image ? frame.sizeOf(port) : glm::uvec2(frame.countOf(port), 1));
}

}  // namespace lodestir
