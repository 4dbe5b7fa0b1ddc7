// SPDX-License-Identifier: MIT
// `lodestir view`: renders a graph into a window, with panels made from its declarations.
#include <framework/app/commands/commands.h>

#include <framework/app/view/canvas.h>
#include <framework/app/command_line.h>
#include <framework/app/view/panels.h>
#include <framework/app/view/self_report.h>
#include <framework/app/validators.h>
#include <framework/core/is_file.h>
#include <framework/core/log.h>

#include <memory>
#include <optional>

namespace lodestir {
namespace {

struct ViewOptions {
    SessionOptions session;
    ComparedFirst compared;
    std::optional<glm::uvec2> window;  ///< points; none: as it was when it was last closed
    Path out = "out", selfReport;
    double frameTime = 0;            ///< milliseconds that the size of frames follows; 0: none
    std::optional<Path> screenshot;  ///< where one is wanted at the end, too
};

/// "restir_pt.json:no spatial": what stands behind the last colon is a variant, unless the whole is a file.
void takeCompared(const std::string& text, ComparedFirst& compared) {
    const std::size_t colon = isFile(text) ? std::string::npos : text.rfind(':');
    compared.graph = text.substr(0, colon);
    if (colon != std::string::npos) compared.variant = text.substr(colon + 1);
    if (!isFile(compared.graph)) refuseOption("--compare", "there is no file " + compared.graph.string());
}

/// Draws the window until it is closed; the renderer has a thread of its own.
int showWindow(const ViewOptions& options) {
    SessionOptions sessionOptions = options.session;
    const auto frames = std::uint64_t(sessionOptions.changes.frames.value_or(0));
    sessionOptions.changes.frames.reset();  // here it says when to quit
    Window window(glm::ivec2(options.window.value_or(glm::uvec2(1440, 900))), sessionOptions.graph.filename().string(),
                  options.window ? std::nullopt : readWindowPlace());
    const auto device =
        std::make_shared<const gpu::Device>(gpu::DeviceOptions{.choice = sessionOptions.renderer.device, .windowExtensions = window.vulkanExtensions()});
    Canvas canvas(*device, window);
    PicturePainter painter(*device);
    Comparison comparison(*device);
    Viewport viewport;
    SelfReport report(options.selfReport);
    std::string failure;
    {
        RenderThread renderer(sessionOptions, options.compared, device, frames, [] { Window::wake(); });
        Panels panels(renderer, window, viewport, comparison, options.out, float(options.frameTime), report.wanted());
        using Clock = Window::Clock;
        // On a CPU driver drawing the window takes time from rendering: what nobody waits for is drawn less often.
        const auto pause = std::chrono::milliseconds(device->facts().type == "cpu" ? 80 : 12);
        constexpr auto rest = std::chrono::milliseconds(30);
        Clock::time_point drawn{};
        std::shared_ptr<const ViewStatus> seen;
        int settle = 3;  // drawings that are due: panels need a few to come to rest, but new input goes first
        while (!window.shouldClose()) {
            const Clock::time_point now = Clock::now(), idle = now + std::chrono::milliseconds(250),
                                    due = settle > 0 ? drawn + rest : renderer.status() != seen ? drawn + pause : idle;
            const auto input = window.takeInput(std::max(0.0, std::chrono::duration<double>(due - now).count()));
            const std::shared_ptr<const ViewStatus> status = renderer.status();
            const auto since = Clock::now() - drawn;
            if (!input && !(settle > 0 && since >= rest) && !(status != seen && since >= pause)) continue;
            settle = input ? 2 : std::max(settle - 1, 0);
            if (!status->failure.empty()) {
                failure = status->failure;
                break;
            }
            if (!canvas.begin()) continue;
            seen = status;
            const bool last = frames > 0 && status->framesDone >= frames;
            const Rectangle area = panels.pictureArea(canvas.points()), pixels = area.inPixels(canvas.density());
            if (const auto moved = viewport.interact(area, status->picture.extent, status->camera))
                renderer.post([key = *moved](ViewSession& s) { s.setCamera(key); });
            panels.draw(*status);
            panels.drawProbe(*status, painter.probe(), area);
            const bool shows = status->picture.texels && area.size.x > 0 && area.size.y > 0;
            const bool wished = panels.takeScreenshotWish() || (last && options.screenshot);
            canvas.end(
                [&](gpu::Commands& commands) {
                    if (!shows) return;
                    const float point = 1 / canvas.density();
                    const glm::mat3 toImage = viewport.toImage(status->picture) * glm::mat3(point, 0, 0, 0, point, 0, 0, 0, 1);
                    painter.prepare(commands, status->picture, comparison.subtracted(status->picture, panels.layout()), panels.layout(), panels.look(), pixels,
                                    toImage, viewport.pixelUnderPointer(), canvas.blueFirst());
                    comparison.prepare(commands, pixels, toImage, canvas.blueFirst());
                },
                [&](gpu::Commands& commands, VkImage image) {
                    if (shows) comparison.paint(commands, image, painter);
                },
                wished ? options.screenshot.value_or(options.out / "view.png") : Path());
            drawn = Clock::now();
            if (input && seen->graph && report.wanted()) {
                canvas.wait();
                report.answered(*input);
            }
            report.write(*status, panels, viewport, pixels, canvas.density());
            if (last) break;
        }
        canvas.wait();  // the last drawing uses what ends before the canvas does
        if (!options.window) keepWindowPlace(window.place());
    }
    if (!failure.empty()) throw Error(failure);
    if (!device->validationMessages().empty())
        throw Error(std::to_string(device->validationMessages().size()) + " validation messages; the first: " + device->validationMessages()[0]);
    return 0;
}

}  // namespace

void addView(CLI::App& app, std::function<int()>& run) {
    auto options = std::make_shared<ViewOptions>();
    Command command(app, "view", "Renders a graph into a window: any port, all parameters, a camera to move, live reload.");
    options->session.addTo(command);
    command.find("--frames").about("quit after this many frames");
    command.taken<std::string>("--window", [options](const std::string& v) { options->window = readSize("--window", v); },
                               "size of the window in points, WIDTHxHEIGHT (else it is where, and as large as, it was when it was last closed)");
    command.option("--frame-time", options->frameTime, "milliseconds that a frame is to take: its size follows, up to that of the window")
        .check(checkPositive);
    command.option("--out", options->out, "folder for what is saved").showDefault();
    command.taken<std::string>("--compare", [options](const std::string& v) { takeCompared(v, options->compared); },
                               "graph that runs beside it as A: GRAPH or GRAPH:VARIANT");
    command.option("--reference", options->compared.image, "image that errors are shown against, as large as frames").check(checkNotEmpty);
    command.taken<std::string>("--screenshot", [options](const std::string& v) { options->screenshot = v; },
                               "PNG of the window, written by F12 (else view.png in --out) and when --frames are done");
    command.option("--self-report", options->selfReport, "JSON of what the viewer knows about itself, for tests");
    command.does(run, [options] { return showWindow(*options); });
}

}  // namespace lodestir
