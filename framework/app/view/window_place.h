// SPDX-License-Identifier: MIT
// Where the viewer's window was when it was last closed: `window.json` in $XDG_STATE_HOME/lodestir, else in ~/.local/state/lodestir.
#pragma once
#include <glm/glm.hpp>

#include <optional>

namespace lodestir {

/// In the desktop's own units, without the frame that a window manager draws.
struct WindowPlace {
    glm::ivec2 corner{0}, size{0};
    bool maximised = false;  ///< corner and size are those before
};

/// Nothing where none was kept, or what was kept can't be read.
std::optional<WindowPlace> readWindowPlace();
/// Says in the log why it can't be kept.
void keepWindowPlace(const WindowPlace& place);

}  // namespace lodestir
