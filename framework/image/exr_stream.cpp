// SPDX-License-Identifier: MIT
// OpenEXR's streams over memory.
#include <framework/image/exr_stream.h>

#include <IexBaseExc.h>

#include <cstring>

namespace lodestir {

bool ExrInput::read(char to[], int count) {
    const auto wanted = static_cast<std::uint64_t>(count);
    if (count < 0 || position_ > bytes_.size() || wanted > bytes_.size() - position_) throw Iex::InputExc("the file ends too early");
    std::memcpy(to, bytes_.data() + position_, wanted);
    position_ += wanted;
    return position_ < bytes_.size();
}

void ExrOutput::write(const char from[], int count) {
    const auto length = static_cast<std::size_t>(count);
    if (position_ + length > bytes_.size()) bytes_.resize(position_ + length);
    std::memcpy(bytes_.data() + position_, from, length);
    position_ += length;
}

}  // namespace lodestir
