// SPDX-License-Identifier: MIT
// A window of the desktop and what comes in through it. The only place that asks for a display.
#pragma once
#include <framework/app/view/window_place.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct GLFWwindow;

namespace lodestir {

class Window {
public:
    using Clock = std::chrono::steady_clock;

    /// `size`: points; `subject`: as in setTitle(); `place`: where it was, which goes before, as long as a screen is there still.
    /// Error where there is no display.
    Window(glm::ivec2 size, const std::string& subject, const std::optional<WindowPlace>& place);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    std::vector<std::string> vulkanExtensions() const;  ///< of the instance, for gpu::DeviceOptions
    bool shouldClose() const;
    glm::ivec2 size() const;  ///< of what is drawn, pixels; {0, 0} while it is minimised
    float density() const;    ///< pixels that the desktop wants a point of type and panels to have: 1 on common screens, 2 where they are small
    void setTitle(const std::string& subject);  ///< behind the program's name
    void setClipboard(const std::string& text);

    /// Takes what came in, waiting up to `seconds` for something. Where that is input of the user: a time that it didn't come before.
    std::optional<Clock::time_point> takeInput(double seconds);
    struct Key {
        int key;  ///< GLFW's number
        bool control, shift;
    };
    /// The keys that went down since this was last asked, even those that are up again.
    std::vector<Key> takeKeys() { return std::exchange(keys_, {}); }
    /// Files that were dropped on the window since this was last asked.
    std::vector<std::filesystem::path> takeDrops() { return std::exchange(drops_, {}); }
    /// Where it is by now, or was before it was maximised.
    WindowPlace place() const;
    static void wake();  ///< ends the wait; from any thread

private:
    void notePlace();

    GLFWwindow* window_ = nullptr;
    WindowPlace place_;  ///< while it was neither maximised nor minimised
    bool input_ = false;
    std::vector<Key> keys_;
    std::vector<std::filesystem::path> drops_;
    Clock::time_point taken_ = Clock::now();  ///< when the last look for input ended
};

}  // namespace lodestir
