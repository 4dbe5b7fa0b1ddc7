// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/core/log.h>
#include <framework/core/tasks.h>
#include <framework/study/workers.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lodestir {
namespace {

/// What is sent either way: a kind, and a text after its length.
enum class Message : char { item, opened, made, threw };

bool sendBytes(int channel, const void* bytes, std::size_t count) {
    for (std::size_t done = 0; done < count;) {
        const ssize_t sent = ::send(channel, static_cast<const char*>(bytes) + done, count - done, MSG_NOSIGNAL);
        if (sent < 0 && errno != EINTR) return false;
        done += std::size_t(std::max<ssize_t>(sent, 0));
    }
    return true;
}
bool receiveBytes(int channel, void* bytes, std::size_t count) {
    for (std::size_t done = 0; done < count;) {
        const ssize_t received = ::recv(channel, static_cast<char*>(bytes) + done, count - done, 0);
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) return false;
        done += std::size_t(received);
    }
    return true;
}
bool sendMessage(int channel, Message kind, const std::string& text) {
    const std::uint64_t length = text.size();
    return sendBytes(channel, &kind, sizeof kind) && sendBytes(channel, &length, sizeof length) && sendBytes(channel, text.data(), text.size());
}
bool receiveMessage(int channel, Message& kind, std::string& text) {
    std::uint64_t length = 0;
    if (!receiveBytes(channel, &kind, sizeof kind) || !receiveBytes(channel, &length, sizeof length)) return false;
    text.resize(length);
    return receiveBytes(channel, text.data(), text.size());
}

[[noreturn]] void beWorker(const Work& work, int channel, pid_t parent, std::size_t threads) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) std::_Exit(1);
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);  // sent to the whole group, they are the parent's to answer
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);           // of lavapipe: the cores are shared out
    log::setQuiet(true);
    Message kind = Message::item;
    std::string text;
    try {
        const WorkDevice device = work.open();
        bool goesOn = sendMessage(channel, Message::opened, (device.isCpu ? "c" : "g") + device.name);
        while (goesOn && receiveMessage(channel, kind, text)) goesOn = sendMessage(channel, Message::made, work.make(std::stoull(text)));
    } catch (const std::exception& exception) {
        sendMessage(channel, Message::threw, exception.what());
    }
    std::_Exit(0);  // destructors of globals are the parent's business
}

struct Worker {
    pid_t process = -1;
    int channel = -1;
    std::size_t item = WorkQueue::none;  ///< that it is at
    bool opened = false;
};

/// The children, and what they are at.
class Workers {
public:
    Workers(const Work& work, const Jobs& jobs) : work_(work), jobs_(jobs), queue_(work.items) {}
    ~Workers() {
        for (Worker& worker : workers_) end(worker);
    }

    std::string run() {
        start();  // the first one tells what the device is
        while (!workers_.empty() && serve()) {}
        return problem_;
    }

private:
    std::size_t threads() const { return std::max<std::size_t>(1, workerCount() / std::max<std::size_t>(1, wanted())); }
    std::size_t wanted() const { return std::min(jobs_.count > 0 ? std::size_t(jobs_.count) : workerCount(), work_.items.size()); }

    void start() {
        std::fflush(nullptr);  // or both would write what is buffered
        int channels[2];
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, channels) != 0)
            throw Error("no channel to a worker: " + std::generic_category().message(errno));
        const pid_t parent = ::getpid(), child = ::fork();
        if (child == 0) {
            ::close(channels[0]);
            for (const Worker& other : workers_) ::close(other.channel);
            beWorker(work_, channels[1], parent, threads());
        }
        const int reason = errno;
        ::close(channels[1]);
        if (child < 0) {
            ::close(channels[0]);
            throw Error("no worker: " + std::generic_category().message(reason));
        }
        workers_.push_back({.process = child, .channel = channels[0]});
    }

    /// Waits for the end of a worker; the signal that ended it, 0: none.
    static int end(Worker& worker) {
        ::close(worker.channel);
        int status = 0;
        while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {}
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    bool isOver() const { return !problem_.empty() || queue_.empty() || work_.stops(); }

    void give(std::size_t index) {
        Worker& worker = workers_[index];
        if (!worker.opened || worker.item != WorkQueue::none || isOver()) return;
        worker.item = queue_.next(index);
        if (worker.item != WorkQueue::none) sendMessage(worker.channel, Message::item, std::to_string(worker.item));
    }

    /// Gives every idle worker an item, and takes what was sent. False: nothing is left to wait for.
    bool serve() {
        for (std::size_t i = 0; i < workers_.size(); ++i) give(i);
        std::vector<pollfd> waiting;
        for (const Worker& worker : workers_) waiting.push_back({worker.channel, POLLIN, 0});
        const bool busy = std::ranges::any_of(workers_, [](const Worker& w) { return !w.opened || w.item != WorkQueue::none; });
        if (!busy) return false;
        if (::poll(waiting.data(), waiting.size(), -1) <= 0) return true;  // a signal: the next turn asks whether it is over
        for (std::size_t i = 0; i < waiting.size(); ++i)
            if (waiting[i].revents != 0 && !receive(i)) return !workers_.empty();
        return true;
    }

    /// False where the worker is gone.
    bool receive(std::size_t index) {
        Worker& worker = workers_[index];
        Message kind{};
        std::string text;
        if (!receiveMessage(worker.channel, kind, text)) {
            const int signal = end(worker);
            problem_ = "a worker was ended by " + (signal != 0 ? fmt::format("signal {}, {}", signal, ::strsignal(signal)) : std::string("itself"));
            workers_.erase(workers_.begin() + std::ptrdiff_t(index));
            return false;
        }
        if (kind == Message::threw) {
            problem_ = text;
            end(worker);
            workers_.erase(workers_.begin() + std::ptrdiff_t(index));
            return false;
        }
        if (kind == Message::opened) {
            worker.opened = true;
            if (!progress_) open(text);
            return true;
        }
        const std::size_t item = std::exchange(worker.item, WorkQueue::none);
        queue_.done(item);
        give(index);  // before the disk is waited for
        work_.take(item, text);
        progress_->advance();
        return true;
    }

    void open(const std::string& device) {
        const bool isCpu = device.front() == 'c';
        const std::size_t count = jobs_.count > 0 || isCpu ? wanted() : 1;
        log::note("{} to make on {}, by {}", work_.count, device.substr(1), count > 1 ? fmt::format("{} processes", count) : "one process");
        progress_.emplace(work_.what, work_.items.size());
        while (workers_.size() < count && !isOver()) start();
    }

    const Work& work_;
    const Jobs& jobs_;
    WorkQueue queue_;
    std::vector<Worker> workers_;
    std::optional<log::Progress> progress_;
    std::string problem_;
};

void workAlone(const Work& work, const Jobs& jobs) {
    log::note("{} to make on {}{}", work.count, work.open().name, jobs.why.empty() ? "" : ", by one process: " + jobs.why);
    log::Progress progress(work.what, work.items.size());
    WorkQueue queue(work.items);
    for (std::size_t item; !work.stops() && (item = queue.next(0)) != WorkQueue::none; queue.done(item)) {
        work.take(item, work.make(item));
        progress.advance();
    }
}

}  // namespace

WorkQueue::WorkQueue(const std::vector<WorkItem>& items) : items_(items), begun_(items.size()), left_(items.size()) {
    for (const WorkItem& item : items)
        if (item.opens) ++opening_[item.scene];
}

std::size_t WorkQueue::next(std::size_t worker) {
    if (groups_.size() <= worker) groups_.resize(worker + 1, none);
    while (first_ < items_.size() && begun_[first_]) ++first_;
    std::size_t any = none, free = none;
    for (std::size_t i = first_; i < items_.size(); ++i) {
        const WorkItem& item = items_[i];
        if (begun_[i] || (!item.opens && opening_[item.scene] > 0)) continue;
        if (item.group == groups_[worker]) {
            any = i;
            free = none;
            break;
        }
        if (any == none) any = i;
        if (free == none && std::ranges::find(groups_, item.group) == groups_.end()) free = i;
    }
    const std::size_t chosen = free != none ? free : any;
    if (chosen == none) return none;
    groups_[worker] = items_[chosen].group;
    begun_[chosen] = true;
    --left_;
    return chosen;
}

void WorkQueue::done(std::size_t item) {
    if (items_[item].opens) --opening_[items_[item].scene];
}

std::string doWork(const Work& work, const Jobs& jobs) {
    if (work.items.empty()) return {};
    if (jobs.count != 1) return Workers(work, jobs).run();
    workAlone(work, jobs);
    return {};
}

}  // namespace lodestir
