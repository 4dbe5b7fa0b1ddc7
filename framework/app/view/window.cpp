// SPDX-License-Identifier: MIT
#include <framework/app/view/window.h>

#include <framework/core/error.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace lodestir {
namespace {

std::string lastProblem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

}  // namespace

Window::Window(glm::ivec2 size, const std::string& title) {
    if (!glfwInit())
        throw Error("there is no display to open a window on (" + lastProblem() + ")",
                    "`lodestir run` renders without one; `xvfb-run lodestir view ...` gives it one in memory");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
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
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
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

void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

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
