// SPDX-License-Identifier: MIT
// Spreads work over threads that are started for it. Starting one costs some 20 us, little beside the work this is for (BVHs, images),
// and leaves no pool behind whose life would have to be managed.
#include <framework/core/tasks.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace lodestir {
namespace {

/// Cores without work: the one thing that nested calls must share, or they would start workers times workers threads.
std::atomic<std::size_t>& idleCores() {
    static std::atomic<std::size_t> idle{workerCount() - 1};
    return idle;
}

/// Some idle cores, held until the end of the scope.
class Cores {
public:
    explicit Cores(std::size_t wanted) {
        std::size_t idle = idleCores().load();
        do count_ = std::min(wanted, idle);
        while (!idleCores().compare_exchange_weak(idle, idle - count_));
    }
    ~Cores() { idleCores().fetch_add(count_); }
    Cores(const Cores&) = delete;
    Cores& operator=(const Cores&) = delete;

    std::size_t count() const { return count_; }

private:
    std::size_t count_ = 0;
};

/// The exception of the chunk that comes first. Chunks are handed out in order and run to their end, so it is the same one every time.
class FirstException {
public:
    void keep(std::size_t chunk, std::exception_ptr exception) {
        const std::lock_guard lock(mutex_);
        if (chunk < chunk_) {
            chunk_ = chunk;
            exception_ = std::move(exception);
        }
    }
    void rethrow() const {
        if (exception_) std::rethrow_exception(exception_);
    }

private:
    std::mutex mutex_;
    std::size_t chunk_ = std::numeric_limits<std::size_t>::max();
    std::exception_ptr exception_;
};

}  // namespace

std::size_t workerCount() { return std::max(1u, std::thread::hardware_concurrency()); }

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t begin, std::size_t end)>& body) {
    if (count == 0) return;
    // Eight chunks a core even out bodies of unequal cost; many more would only be overhead.
    const std::size_t chunks = std::clamp<std::size_t>(count / std::max<std::size_t>(grain, 1), 1, 8 * workerCount());
    const auto bound = [&](std::size_t chunk) { return count / chunks * chunk + std::min(chunk, count % chunks); };

    std::atomic<std::size_t> next{0};
    FirstException exception;
    const auto work = [&] {
        for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
            try {
                body(bound(chunk), bound(chunk + 1));
            } catch (...) {
                exception.keep(chunk, std::current_exception());
                next = chunks;  // the others finish what they are at
            }
        }
    };
    {
        const Cores cores(chunks - 1);
        std::vector<std::jthread> threads;
        try {
            for (std::size_t i = 0; i < cores.count(); ++i) threads.emplace_back(work);
        } catch (const std::system_error&) {
            // The system gives no more threads: those that run, and this one, do all the work.
        }
        work();
    }
    exception.rethrow();
}

void parallelInvoke(const std::function<void()>& first, const std::function<void()>& second) {
    parallelFor(2, 1, [&](std::size_t begin, std::size_t end) {
        if (begin == 0) first();
        if (end == 2) second();
    });
}

}  // namespace lodestir
