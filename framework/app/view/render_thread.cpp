// SPDX-License-Identifier: MIT
#include <framework/app/view/render_thread.h>

#include <chrono>

namespace lodestir {

RenderThread::RenderThread(const SessionOptions& options, const ComparedFirst& first, std::shared_ptr<const gpu::Device> device, std::uint64_t frames,
                           std::function<void()> wake)
    : wake_(std::move(wake)),
      status_(std::make_shared<ViewStatus>()),
      thread_([this, options, first, device = std::move(device), frames] { run(options, first, device, frames); }) {}

RenderThread::~RenderThread() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    something_.notify_all();
    thread_.join();
}

void RenderThread::post(Task task) {
    {
        const std::lock_guard lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    something_.notify_all();
}

std::shared_ptr<const ViewStatus> RenderThread::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

void RenderThread::publish(const ViewStatus& status) {
    auto copy = std::make_shared<const ViewStatus>(status);
    {
        const std::lock_guard lock(mutex_);
        status_ = std::move(copy);
    }
    wake_();
}

void RenderThread::run(const SessionOptions& options, const ComparedFirst& first, const std::shared_ptr<const gpu::Device>& device,
                       std::uint64_t frames) {
    using Clock = std::chrono::steady_clock;
    constexpr auto lookEvery = std::chrono::milliseconds(500);
    try {
        ViewSession session(options, first, device, [this](const ViewStatus& status) { publish(status); });
        session.build();
        Clock::time_point looked = Clock::now();
        for (;;) {
            std::deque<Task> tasks;
            {
                std::unique_lock lock(mutex_);
                const bool rests = !session.wantsFrame() || (frames > 0 && status_->framesDone >= frames);
                if (rests) something_.wait_for(lock, lookEvery, [&] { return stop_ || !tasks_.empty(); });
                if (stop_) return;
                tasks.swap(tasks_);
            }
            for (const Task& task : tasks) task(session);
            if (Clock::now() - looked >= lookEvery) {
                session.reloadChanged();
                looked = Clock::now();
            }
            if (session.wantsFrame() && (frames == 0 || status()->framesDone < frames)) session.frame();
        }
    } catch (const std::exception& error) {
        ViewStatus failed = *status();
        failed.failure = error.what();
        publish(failed);
    }
}

}  // namespace lodestir
