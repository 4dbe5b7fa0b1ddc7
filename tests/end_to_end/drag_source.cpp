// SPDX-License-Identifier: MIT
// Drops files on the window of a display that takes files, as a file manager does: the XDND protocol, version 5
// (freedesktop.org, "Drag-and-Drop Protocol for the X Window System"). Arguments: their URIs.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace {

class DragSource {
public:
    explicit DragSource(Display* display)
        : display_(display), window_(XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0)), uris_(atom("text/uri-list")) {}

    /// What went wrong; empty: the files were taken.
    std::string drop(const std::string& uris) {
        const Window target = awareOf(DefaultRootWindow(display_));
        if (target == None) return "no window takes files";
        int x = 0, y = 0;
        Window child = None;
        XWindowAttributes shape{};
        XGetWindowAttributes(display_, target, &shape);
        XTranslateCoordinates(display_, target, DefaultRootWindow(display_), shape.width / 2, shape.height / 2, &x, &y, &child);
        XSetSelectionOwner(display_, atom("XdndSelection"), window_, CurrentTime);
        send(target, "XdndEnter", 5L << 24, long(uris_), 0, 0);
        send(target, "XdndPosition", 0, long(x) << 16 | y, CurrentTime, long(atom("XdndActionCopy")));
        const XClientMessageEvent status = await("XdndStatus", uris);
        if (status.type == 0) return "the window doesn't answer";
        if (!(status.data.l[1] & 1)) return "the window refuses";
        send(target, "XdndDrop", 0, CurrentTime, 0, 0);
        return await("XdndFinished", uris).type == 0 ? "the files aren't fetched" : "";
    }

private:
    Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    /// The first window, from `window` inwards, that says that it takes what is dropped.
    Window awareOf(Window window) const {
        Atom type = None;
        int format = 0;
        unsigned long count = 0, rest = 0;
        unsigned char* data = nullptr;
        XGetWindowProperty(display_, window, atom("XdndAware"), 0, 1, False, AnyPropertyType, &type, &format, &count, &rest, &data);
        if (data) XFree(data);
        if (type != None) return window;
        Window root = None, parent = None, *children = nullptr;
        unsigned int childCount = 0;
        XQueryTree(display_, window, &root, &parent, &children, &childCount);
        Window found = None;
        for (unsigned int i = 0; i < childCount && found == None; ++i) found = awareOf(children[i]);
        if (children) XFree(children);
        return found;
    }

    void send(Window target, const char* message, long a, long b, long c, long d) const {
        XEvent event{};
        event.xclient = {.type = ClientMessage, .serial = 0, .send_event = True, .display = display_, .window = target, .message_type = atom(message),
                         .format = 32, .data = {}};
        const long values[] = {long(window_), a, b, c, d};
        for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = values[i];
        XSendEvent(display_, target, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// A message of the target, while it is given the URIs that it asks for. Type 0: none in 20 seconds.
    XClientMessageEvent await(const char* message, const std::string& uris) const {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (std::chrono::steady_clock::now() < end) {
            if (XPending(display_) == 0) {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
                continue;
            }
            XEvent event;
            XNextEvent(display_, &event);
            if (event.type == ClientMessage && event.xclient.message_type == atom(message)) return event.xclient;
            if (event.type != SelectionRequest) continue;
            const XSelectionRequestEvent& asked = event.xselectionrequest;
            XChangeProperty(display_, asked.requestor, asked.property, uris_, 8, PropModeReplace, reinterpret_cast<const unsigned char*>(uris.data()),
                            int(uris.size()));
            XEvent answer{};
            answer.xselection = {.type = SelectionNotify, .serial = 0, .send_event = True, .display = display_, .requestor = asked.requestor,
                                 .selection = asked.selection, .target = asked.target, .property = asked.property, .time = asked.time};
            XSendEvent(display_, asked.requestor, False, NoEventMask, &answer);
            XFlush(display_);
        }
        return {};
    }

    Display* display_;
    Window window_;
    Atom uris_;
};

}  // namespace

int main(int count, char** arguments) {
    Display* display = XOpenDisplay(nullptr);
    if (!display) return 2;
    std::string uris;
    for (int i = 1; i < count; ++i) uris += std::string(arguments[i]) + "\r\n";
    const std::string problem = DragSource(display).drop(uris);
    if (!problem.empty()) std::fprintf(stderr, "%s\n", problem.c_str());
    XCloseDisplay(display);
    return problem.empty() ? 0 : 1;
}
