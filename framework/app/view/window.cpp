// SPDX-License-Identifier: MIT
#include <framework/app/view/window.h>

#include <framework/core/error.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace lodestir {
namespace {

std::string lastProblem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

std::string titleOf(const std::string& subject) { return "Lodestir: " + subject; }

/// Whether the middle of its upper edge, by which it is moved, can be reached.
bool isOnAScreen(const WindowPlace& place) {
    const glm::ivec2 handle = place.corner + glm::ivec2(place.size.x / 2, 8);
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        glm::ivec2 corner, size;
        glfwGetMonitorWorkarea(monitors[i], &corner.x, &corner.y, &size.x, &size.y);
        if (glm::all(glm::greaterThanEqual(handle, corner)) && glm::all(glm::lessThan(handle, corner + size))) return true;
    }
    return false;
}

}  // namespace

Window::Window(glm::ivec2 size, const std::string& subject, const std::optional<WindowPlace>& place) {
    if (!glfwInit())
        throw Error("there is no display to open a window on (" + lastProblem() + ")",
                    "`lodestir run` renders without one; `xvfb-run lodestir view ...` gives it one in memory");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // until it is in its place
    glfwWindowHint(GLFW_MAXIMIZED, place && place->maximised);
    window_ = glfwCreateWindow(size.x, size.y, titleOf(subject).c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string problem = lastProblem();
        glfwTerminate();
        throw Error("no window could be opened: " + problem);
    }
    glfwSetWindowUserPointer(window_, this);
    // Only noted here: what the input means is told by the panels, whose own callbacks are chained to these.
    constexpr auto note = [](GLFWwindow* w, auto...) { static_cast<Window*>(glfwGetWindowUserPointer(w))->input_ = true; };
    glfwSetCursorPosCallback(window_, note);
    glfwSetMouseButtonCallback(window_, note);
    glfwSetScrollCallback(window_, note);
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
        Window& window = *static_cast<Window*>(glfwGetWindowUserPointer(w));
        window.input_ = true;
        if (action == GLFW_PRESS) window.keys_.push_back({key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetCharCallback(window_, note);
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** names) {
        Window& window = *static_cast<Window*>(glfwGetWindowUserPointer(w));
        window.input_ = true;
        window.drops_.insert(window.drops_.end(), names, names + count);
    });
    glfwSetFramebufferSizeCallback(window_, note);
    glfwSetWindowRefreshCallback(window_, note);
    constexpr auto moved = [](GLFWwindow* w, int, int) { static_cast<Window*>(glfwGetWindowUserPointer(w))->notePlace(); };
    glfwSetWindowPosCallback(window_, moved);
    glfwSetWindowSizeCallback(window_, moved);
    if (place) {
        place_ = *place;
        glfwSetWindowSize(window_, place->size.x, place->size.y);
        if (isOnAScreen(*place)) glfwSetWindowPos(window_, place->corner.x, place->corner.y);
    }
    glfwShowWindow(window_);
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

void Window::notePlace() {
    if (glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) || glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return;
    glfwGetWindowPos(window_, &place_.corner.x, &place_.corner.y);
    glfwGetWindowSize(window_, &place_.size.x, &place_.size.y);
}

WindowPlace Window::place() const {
    WindowPlace place = place_;
    place.maximised = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) != 0;
    return place;
}

std::vector<std::string> Window::vulkanExtensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (!names) throw Error("Vulkan can't draw into windows here: " + lastProblem(), "`lodestir run` renders without one");
    return {names, names + count};
}

bool Window::shouldClose() const { return glfwWindowShouldClose(window_); }

glm::ivec2 Window::size() const {
    glm::ivec2 size;
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float Window::density() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::clamp(x, 0.5f, 8.0f);  // whatever a desktop may say
}

void Window::setTitle(const std::string& subject) { glfwSetWindowTitle(window_, titleOf(subject).c_str()); }

void Window::setClipboard(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }

std::optional<Window::Clock::time_point> Window::takeInput(double seconds) {
    // What is there at once may have come at any time since the last look; what ends the wait came just now.
    Clock::time_point earliest = taken_;
    input_ = false;
    glfwPollEvents();
    if (!input_ && seconds > 0) {
        glfwWaitEventsTimeout(seconds);
        earliest = Clock::now();
    }
    taken_ = Clock::now();
    return input_ ? std::optional(earliest) : std::nullopt;
}

void Window::wake() { glfwPostEmptyEvent(); }

}  // namespace lodestir
