// SPDX-License-Identifier: MIT
// The viewer as a person meets it: a window on a virtual display, a mouse that drags and clicks, keys. What it does is read from its self-report.
#pragma once
#include "program.h"

#include <framework/image/png.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <optional>
#include <thread>

namespace lodestir::test {

using namespace std::chrono_literals;

inline bool isInstalled(const std::string& program) { return runProcess({"bash", "-c", "command -v " + program}).exitCode == 0; }

/// An X server that draws into memory.
class VirtualDisplay {
public:
    explicit VirtualDisplay(const Path& folder)
        : server_({"bash", "-c", "exec Xvfb -displayfd 3 -screen 0 1280x800x24 -noreset -nolisten tcp 3>" + (folder / "display").string()}) {
        for (int i = 0; i < 400 && number_.empty(); ++i) {
            std::this_thread::sleep_for(25ms);
            std::getline(std::ifstream(folder / "display") >> std::ws, number_);
        }
    }
    ~VirtualDisplay() { server_.kill(SIGTERM); }
    bool works() { return !number_.empty() && server_.running(); }
    std::string name() const { return ":" + number_; }
    void xdotool(Arguments arguments) const {
        arguments.insert(arguments.begin(), "xdotool");
        const Output output = runProcess(arguments, {{"DISPLAY", name()}});
        EXPECT_EQ(output.exitCode, 0) << commandText(arguments) << "\n" << output.err;
    }

private:
    Process server_;
    std::string number_;
};

/// `lodestir view` on a virtual display.
class Viewer {
public:
    Viewer(const VirtualDisplay& display, const Path& folder, const Path& graph, Arguments arguments, Environment environment = {})
        : display_(display),
          report_(folder / "report.json"),
          process_(command(folder, graph, std::move(arguments), environment), environmentOf(display, environment)) {}

    /// The report once `holds` is true of it; the test fails when that takes longer than a minute.
    OrderedJson await(const std::string& what, const std::function<bool(const OrderedJson&)>& holds, std::chrono::duration<double> patience = 60s) {
        const auto end = std::chrono::steady_clock::now() + patience;
        OrderedJson last;
        while (std::chrono::steady_clock::now() < end && process_.running()) {
            std::error_code none;
            if (std::filesystem::exists(report_, none)) {
                last = OrderedJson::parse(readText(report_));
                if (holds(last)) return last;
            }
            std::this_thread::sleep_for(20ms);
        }
        ADD_FAILURE() << "in vain waited for: " << what << (process_.running() ? "" : " (the viewer has ended)") << "\n" << last.dump(1).substr(0, 3000);
        return last;
    }
    OrderedJson report() { return await("a report", [](const OrderedJson&) { return true; }); }

    void point(double x, double y) const { display_.xdotool({"mousemove", std::to_string(int(x)), std::to_string(int(y))}); }
    void key(const std::string& key) {
        ++actions_;
        display_.xdotool({"key", key});
    }
    int actions() const { return actions_; }  ///< clicks, drags and keys so far
    /// The place of a widget once it rests; one that is scrolled away is scrolled to.
    OrderedJson find(const std::string& widget) {
        // A menu takes two drawings to find its place: the box has to be the same for a while.
        OrderedJson box;
        await("widget " + widget, [&](const OrderedJson& r) {
            const OrderedJson now = r["widgets"].contains(widget) ? r["widgets"][widget] : OrderedJson();
            const bool rests = !now.is_null() && now == box;
            const bool hidden = rests && now[3].get<double>() - now[1].get<double>() < 4;
            box = now;
            if (hidden) {
                const OrderedJson& passes = r["widgets"]["passes"];
                point(passes[0].get<double>() + 8, 0.5 * (passes[1].get<double>() + passes[3].get<double>()));
                display_.xdotool({"click", "5"});
            }
            if (hidden || (!now.is_null() && !rests)) std::this_thread::sleep_for(300ms);
            return rests && !hidden;
        });
        return box;
    }
    /// `across`: of its width from the left.
    void pointAt(const std::string& widget, double across = 0.5) {
        const OrderedJson box = find(widget);
        ASSERT_FALSE(box.is_null());
        seen([&] {
            point(box[0].get<double>() + across * (box[2].get<double>() - box[0].get<double>()), 0.5 * (box[1].get<double>() + box[3].get<double>()));
        });
    }
    /// Something that the mouse does, once it is seen: a busy machine draws the window rarely, and takes what comes in between for one movement.
    void seen(const std::function<void()>& act) {
        const int drawn = report()["drawn"].get<int>();
        act();
        await("the window drawn", [&](const OrderedJson& r) { return r["drawn"].get<int>() >= drawn + 2; });
    }
    void press(const std::string& button = "1") {
        seen([&] { display_.xdotool({"mousedown", button}); });
    }
    void release(const std::string& button = "1") {
        seen([&] { display_.xdotool({"mouseup", button}); });
    }
    void click(const std::string& widget, double across = 0.5, const std::string& button = "1") {
        ++actions_;
        pointAt(widget, across);
        press(button);
        release(button);
    }
    /// A number into a slider or field.
    void type(const std::string& widget, const std::string& number) {
        display_.xdotool({"keydown", "ctrl"});
        click(widget);
        display_.xdotool({"keyup", "ctrl"});
        seen([&] { display_.xdotool({"type", "--delay", "60", number}); });
        seen([&] { key("Return"); });
        clickPicture();  // whatever a busy machine made of Return: beside the field it is over
    }
    /// Along a widget, from one share of its width to another.
    void dragAcross(const std::string& widget, double from, double to) {
        ++actions_;
        pointAt(widget, from);
        press();
        pointAt(widget, to);
        release();
    }
    /// The middle of the picture, moved by part of its size.
    std::pair<double, double> picture(double right = 0, double down = 0) {
        const OrderedJson area = report()["area"];
        return {area[0].get<double>() + (0.5 + right) * area[2].get<double>(), area[1].get<double>() + (0.5 + down) * area[3].get<double>()};
    }
    void clickPicture(double right = 0, double down = 0) {
        ++actions_;
        const auto [x, y] = picture(right, down);
        seen([&] { point(x, y); });
        press();
        release();
    }
    void drag(const std::string& button, double right, double down) {
        ++actions_;
        const auto [x, y] = picture();
        const auto [toX, toY] = picture(right, down);
        point(x, y);
        display_.xdotool({"mousedown", button});
        for (int i = 1; i <= 5; ++i) {
            point(x + (toX - x) * i / 5, y + (toY - y) * i / 5);
            std::this_thread::sleep_for(60ms);
        }
        display_.xdotool({"mouseup", button});
    }
    /// The window as it is now; `shot`: what --screenshot says.
    ImageData window(const Path& shot) {
        std::filesystem::remove(shot);
        key("F12");
        await("a picture of the window", [&](const OrderedJson&) {
            std::error_code none;
            return std::filesystem::file_size(shot, none) > 0 && !none;
        });
        std::this_thread::sleep_for(200ms);
        return readPng(shot);
    }
    pid_t pid() const { return process_.pid(); }
    bool running() { return process_.running(); }
    Output wait() { return process_.wait(90s); }

private:
    /// With a window of its own size, but where the test has a folder in which viewers remember theirs.
    static std::vector<std::string> command(const Path& folder, const Path& graph, const Arguments& arguments, const Environment& environment) {
        std::vector<std::string> all{
            LODESTIR_BINARY, "view", graph.string(), "--self-report", (folder / "report.json").string(), "--out", (folder / "out").string()};
        if (std::ranges::find(environment, "XDG_STATE_HOME", &Environment::value_type::first) == environment.end())
            all.insert(all.end(), {"--window", "1280x800"});
        all.insert(all.end(), arguments.begin(), arguments.end());
        return all;
    }
    static Environment environmentOf(const VirtualDisplay& display, Environment environment) {
        environment.insert(environment.end(), {{"DISPLAY", display.name()}, {"LODESTIR_VALIDATION", "1"}});
        return environment;
    }

    const VirtualDisplay& display_;
    Path report_;
    Process process_;
    int actions_ = 0;
};

/// A test with a display of its own; skipped where there can't be one.
class ViewerTest : public ProgramTest {
protected:
    void SetUp() override {
        if (!isInstalled("Xvfb") || !isInstalled("xdotool")) GTEST_SKIP() << "needs Xvfb and xdotool; scripts/setup installs them";
        display.emplace(folder);
        ASSERT_TRUE(display->works());
    }
    /// A path tracer of the Cornell box, small enough that frames are quick.
    Path writeGraph(double exposure = 0) {
        write("graph.json", {{"format", 1},
                             {"scene", (sourceFolder / "scenes/cornell.json").string()},
                             {"frame", {{"size", {160, 90}}, {"seed", 1}}},
                             {"passes",
                              {{"trace", {{"type", "path_tracer"}}},
                               {"accumulate", {{"type", "accumulate"}, {"in", {{"color", "trace"}}}}},
                               {"display", {{"type", "tone_map"}, {"in", {{"color", "accumulate"}}}, {"set", {{"exposure", exposure}}}}}}},
                             {"show", "display"},
                             {"variants", {{"dim", {{"passes", {{"display", {{"set", {{"exposure", -3}}}}}}}}}}}});
        return folder / "graph.json";
    }
    /// What "Save image" writes: its frame.
    static int saveImage(Viewer& viewer) {
        const OrderedJson before = viewer.report()["note"];
        viewer.click("save");
        const std::string note = viewer.await("an image", [&](const OrderedJson& r) {
            return r["note"] != before && r["note"].get<std::string>().find(".exr") != std::string::npos;
        })["note"];
        const std::size_t end = note.find(".exr"), dot = note.rfind('.', end - 1);
        return std::stoi(note.substr(dot + 1, end - dot - 1));
    }
    /// The saved image of a frame is that which a run of a graph makes.
    void expectFrame(const std::string& port, int frame, const Path& graph, Arguments arguments) {
        arguments.insert(arguments.end(), {"--frames", std::to_string(frame + 1), "--show", port});
        run("run", graph, arguments);
        const std::string name = port + "." + std::to_string(frame) + ".exr";
        EXPECT_TRUE(readExrFile(folder / "out" / name).image.values == readExrFile(folder / "run" / name).image.values) << "not the picture of a run";
    }
    static bool rendered(const OrderedJson& r) { return r["frames"].get<int>() >= 3 && r.contains("mean"); }

    std::optional<VirtualDisplay> display;
};

}  // namespace lodestir::test
