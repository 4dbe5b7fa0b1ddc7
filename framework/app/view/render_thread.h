// SPDX-License-Identifier: MIT
// The thread that renders, so that a window can answer while a frame takes its time.
#pragma once
#include <framework/app/view/view_session.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace lodestir {

class RenderThread {
public:
    using Task = std::function<void(ViewSession&)>;
    /// `wake` is called from the thread whenever there is a new status; `frames`: renders that many and then rests, 0: no end.
    RenderThread(const SessionOptions& options, const ComparedFirst& first, std::shared_ptr<const gpu::Device> device, std::uint64_t frames,
                 std::function<void()> wake);
    ~RenderThread();  ///< after the frame in the making
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    void post(Task task);  ///< done between two frames, in order
    std::shared_ptr<const ViewStatus> status() const;

private:
    void run(const SessionOptions& options, const ComparedFirst& first, const std::shared_ptr<const gpu::Device>& device, std::uint64_t frames);
    void publish(const ViewStatus& status);

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable something_;
    std::deque<Task> tasks_;
    std::shared_ptr<const ViewStatus> status_;
    bool stop_ = false;
    std::thread thread_;  // last: it starts when all else is there
};

}  // namespace lodestir
