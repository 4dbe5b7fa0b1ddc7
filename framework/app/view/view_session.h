// SPDX-License-Identifier: MIT
// What a viewer shows, kept running: a session whose files may change, with a camera and parameters set by hand. Used by one thread; no window.
#pragma once
#include <framework/app/session.h>
#include <framework/app/view/compared_sides.h>
#include <framework/app/view/edit_history.h>
#include <framework/app/view/frame_size.h>
#include <framework/app/view/level_edit.h>
#include <framework/app/view/view_state.h>
#include <framework/core/file_watch.h>

#include <chrono>
#include <functional>
#include <map>

namespace lodestir {

/// What is compared from the start.
struct ComparedFirst {
    Path graph;                          ///< that runs as A; empty: none
    std::optional<std::string> variant;  ///< of it
    Path image;                          ///< a reference; empty: none
};

class ViewSession {
public:
    using Publish = std::function<void(const ViewStatus&)>;
    /// `publish` is called after each frame and whenever something else is to be told.
    ViewSession(SessionOptions options, ComparedFirst first, std::shared_ptr<const gpu::Device> device, Publish publish);

    /// Anew from the files; what ran before goes on until its successor has rendered a frame. Problems go to the status, and it returns false. Error
    /// where what is to be compared first can't be.
    bool build();
    void frame();                     ///< the next one
    bool wantsFrame() const;          ///< something runs, and isn't paused or broken
    void reloadChanged();             ///< looks at the files and takes over what changed

    void pause(bool paused);
    void step();                      ///< one frame while paused
    void resetHistory();
    void setFrame(std::uint32_t frame);
    void setCamera(const CameraKey& camera);
    void resetCamera();               ///< to the scene's own path
    void setParameter(const std::string& name, const Value& value);  ///< "pass.parameter"
    void setVariant(const std::string& variant);                     ///< empty: none
    void resize(glm::uvec2 size);     ///< history is void
    /// Whether the size follows the time: a frame is to take so many milliseconds (0: any), and is at most as large as the `window`.
    void followTime(double milliseconds, glm::uvec2 window);

    /// A graph runs in B's place, in the scene that was asked for; a scene or model is what the graph is rendered of; an image is a reference of A.
    void open(const Path& file);

    /// Edits of the graph. One that can't be built changes nothing; the status tells why.
    void turnPass(const std::string& pass, bool off);
    void removePass(const std::string& pass);
    void swapPass(const std::string& pass, const std::string& type);
    void addPass(const std::string& type, const std::map<std::string, std::string>& answers);
    void wireInput(const std::string& pass, const std::string& input, const std::string& from);  ///< `from` empty: nothing
    void undo();
    void redo();
    void dismiss();     ///< what was told of an edit is read
    void offerEdits();  ///< from now on the status says what edits there are, which takes all libraries of passes

    /// A, which what runs (B) is compared with.
    void keepAsA(const Picture& picture, const TexelLayout& layout);
    void runAsA();                                                              ///< what runs now goes on as A
    void runAsA(const Path& graph, const std::optional<std::string>& variant);  ///< as its file has it
    void compareWithImage(const Path& file);
    void releaseA();
    void makeStudy(const Path& folder);  ///< a study file of both sides, with all that it needs

    /// Edits of what the scene shows (view_session_scene.cpp). They are edits of the graph too: of passes that hand on the scene's World changed, which are
    /// put in where there are none.
    void watchScene(bool watched);       ///< whether the status says how it is after each frame
    void pick(glm::vec2 place);          ///< what is seen at a place of the picture, 0..1
    void choose(std::uint32_t instance); ///< as if it had been picked; `none`: nothing
    void forceLevel(std::uint32_t instance, std::optional<int> level);  ///< `none`: of all; no level: as the policy has it
    void moveLevel(std::uint32_t instance, int step);                   ///< the same, so much coarser than it is now
    void addLevelColors();                                              ///< where the graph has none that shows levels in the picture
    /// A parameter of the pass of a type whose parameter `key` is `subject` (no key: of the first such pass).
    struct SceneEdit {
        std::string type, key, subject, parameter;
        Value value;
    };
    void editScene(const SceneEdit& wanted);
    void playPath(const std::vector<CameraKey>& keys);  ///< from its first frame on; the camera is the viewer's own
    void savePath(const Path& file, const std::vector<CameraKey>& keys);  ///< a scene file with this camera path

    /// What is captured after each frame, and the number of it that statistics are made of (`statistics`: whether they are).
    void show(const std::string& port, const TexelLayout& layout, std::uint32_t pick, bool statistics);
    /// What happened to a pixel in the frame that is shown, rendered again with the frames before it by a session that asks.
    void askPixel(glm::ivec2 pixel);
    void forgetPixel();
    void save(const Path& folder);       ///< EXR and PNG of the shown image, .npy of a shown buffer
    void saveGraph(const Path& file);    ///< with all that is set now
    void saveIntoGraph();                ///< edits and parameters, into the graph's own file: they are made by hand no more
    void saveTimes(const Path& folder);  ///< of the last frames: times.csv, and trace.json for Perfetto

private:
    void adjust(Graph& graph);
    HandMade handMade() const { return {options_.changes.variant, options_.changes.patches, options_.changes.set, set_}; }
    bool apply(const std::map<std::string, Value>& set);
    void setParameter(const std::string& what, const std::string& name, const Value& value);  ///< `what`: the step of the history
    bool become(const HandMade& wanted);
    void edit(const std::string& what, const std::string& replaced, const std::function<Json(const Graph&)>& patch);
    const PassType& typeNamed(const std::string& type) const;
    bool attempt(const std::function<void()>& work);
    void took(const FrameReport& report, double wallMilliseconds);
    void capture();
    void describe();
    void describeWires(GraphInfo& info) const;
    void describeEdits(GraphInfo& info) const;
    void describeScene(SceneInfo& info) const;
    void lookAtScene();
    int nodeFor(const SceneEdit& wanted) const;
    std::optional<Source> running(std::string_view type, std::string_view port) const;
    template <class T> std::vector<T> read(const Source& source, std::size_t count) const;  ///< the first elements of a buffer
    float poseFrame(std::uint32_t frame) const;
    std::vector<std::uint32_t> levelsNow() const;
    std::vector<ForcedLevel> forcedNow() const;
    void force(const std::vector<ForcedLevel>& forced);
    void watchFiles();
    void changedByHand(bool restarts);
    void tell();
    void noteDone(const std::string& what);
    std::function<void(std::size_t, std::size_t)> compiling();
    void compareFirst();
    SideGraph sideGraph() const;
    SideGraph sideGraph(const Path& graph, const std::optional<std::string>& variant) const;
    void startA(SideGraph graph);
    void askA(const std::function<void(LiveSide&)>& part);
    void resetBoth();
    void measure(bool always);

    SessionOptions options_;
    ComparedFirst first_;
    std::shared_ptr<const gpu::Device> device_;
    Publish publish_;
    std::unique_ptr<Session> session_;
    std::unique_ptr<Session> asking_;          ///< of the same graph and scene, with shaders that tell; nullptr: nobody has asked
    ViewStatus status_;
    FileWatch watch_;
    std::vector<Path> stale_;                  ///< changed since shaders were last taken over
    std::map<std::string, Value> set_, given_; ///< by hand; by the graph file
    std::optional<CameraPath> scenePath_;      ///< while the camera is the viewer's own: the scene's
    std::string shown_;
    TexelLayout layout_;
    std::uint32_t pick_ = 0;
    EditHistory history_;
    std::vector<PassType> types_;              ///< all, once edits are offered
    bool watchesScene_ = false;
    std::optional<Picked> picked_;
    std::array<glm::vec3, 2> pickedBox_{};     ///< around all levels of its mesh
    bool statistics_ = false, broken_ = false, stepping_ = false, rereadScene_ = false;
    std::optional<FrameSize> frameSize_;       ///< while the size follows the time
    std::vector<FrameReport> reports_;         ///< of the session's last frames of this size
    CameraKey lastCamera_;
    Captures captures_;
    ComparedSides sides_;
    std::vector<std::string> lost_;            ///< problems that A was let go for, to be told
};

}  // namespace lodestir
