// SPDX-License-Identifier: MIT
#include <framework/app/view/edit_history.h>

namespace lodestir {

void EditHistory::did(const std::string& what, HandMade before, Clock::time_point now) {
    using namespace std::chrono_literals;
    const bool goesOn = !done_.empty() && undone_.empty() && done_.back().what == what && now - last_ < 1s;
    last_ = now;
    if (goesOn) return;
    undone_.clear();
    done_.push_back({what, std::move(before)});
}

std::string EditHistory::undoable() const { return done_.empty() ? "" : done_.back().what; }
std::string EditHistory::redoable() const { return undone_.empty() ? "" : undone_.back().what; }

void EditHistory::undid(HandMade before) {
    undone_.push_back({done_.back().what, std::move(before)});
    done_.pop_back();
}

void EditHistory::redid(HandMade before) {
    done_.push_back({undone_.back().what, std::move(before)});
    undone_.pop_back();
    last_ = {};
}

}  // namespace lodestir
