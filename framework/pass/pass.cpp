// SPDX-License-Identifier: MIT
// What every pass does unless it says otherwise.
#include <framework/core/error.h>
#include <framework/pass/pass.h>

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
    // A buffer with something for each pixel is filled pixel by pixel, any other one element by element.
    if (port.type.kind == PortType::Kind::image)
        frame.dispatch(shader, frame.sizeOf(port));
    else if (port.count.kind == Count::Kind::perPixel)
        frame.dispatch(shader, frame.size());
    else
        frame.dispatch(shader, {frame.countOf(port), 1});
}

}  // namespace lodestir
