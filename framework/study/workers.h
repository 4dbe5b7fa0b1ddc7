// SPDX-License-Identifier: MIT
// Work shared out among processes: children of this one, each with a device of its own. Small frames leave cores of a CPU device idle, and a driver's
// threads wait for each other at the end of every dispatch; processes don't.
#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lodestir {

struct WorkItem {
    std::size_t group = 0;  ///< items of one group share what is dear to make: a worker stays with its own while that has any left
    std::size_t scene = 0;
    bool opens = false;  ///< it has to be done before any item of its scene begins that doesn't open it
};

/// What a worker renders on.
struct WorkDevice {
    std::string name;
    bool isCpu = false;
};

struct Work {
    std::string what;   ///< "runs"
    std::string count;  ///< "3 of 8 runs": those of all that are left
    std::vector<WorkItem> items;
    std::function<WorkDevice()> open;                                     ///< in each worker, before its first item
    std::function<std::string(std::size_t item)> make;                    ///< in a worker
    std::function<void(std::size_t item, const std::string& text)> take;  ///< in this process: what make() returned, one item at a time
    std::function<bool()> stops;                                          ///< asked before each item: is the rest left for another time?
};

/// How many processes do it.
struct Jobs {
    int count = 0;    ///< 0: one for each core where the device is a CPU, else one
    std::string why;  ///< of one that was not asked for, as the end of a sentence
};

/// Does items in their order, as far as groups let it, and reports progress. One process is this one; of several, all are children, so that
/// this one opens no device: it must not have any when it calls. Returns what was wrong with a worker that threw or died (empty: nothing); what the
/// others had begun is done then, and nothing else is begun.
std::string doWork(const Work& work, const Jobs& jobs);

/// Items in the order in which they are handed out. A worker is whoever asks.
class WorkQueue {
public:
    explicit WorkQueue(const std::vector<WorkItem>& items);

    static constexpr std::size_t none = std::size_t(-1);
    /// The next item for a worker: of the group of its last one, else of a group that nobody is at, else the first; `none`: nothing is ready.
    std::size_t next(std::size_t worker);
    void done(std::size_t item);
    bool empty() const { return left_ == 0; }  ///< all have been handed out

private:
    const std::vector<WorkItem>& items_;
    std::vector<bool> begun_;
    std::map<std::size_t, std::size_t> opening_;  ///< by scene: items that open it and aren't done
    std::vector<std::size_t> groups_;             ///< of the last item of each worker
    std::size_t first_ = 0;                       ///< item that has not begun
    std::size_t left_;
};

}  // namespace lodestir
