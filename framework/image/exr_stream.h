// SPDX-License-Identifier: MIT
// OpenEXR's streams over memory, so that files are read whole and written aside as all others are.
#pragma once
#include <ImfIO.h>

#include <cstddef>
#include <span>
#include <string>

namespace lodestir {

/// Reads bytes that outlive it; reading beyond their end throws Iex::InputExc.
class ExrInput final : public Imf::IStream {
public:
    ExrInput(std::span<const std::byte> bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

    bool read(char to[], int count) override;
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    std::span<const std::byte> bytes_;
    std::uint64_t position_ = 0;
};

/// Gathers what is written.
class ExrOutput final : public Imf::OStream {
public:
    explicit ExrOutput(const std::string& name) : OStream(name.c_str()) {}

    void write(const char from[], int count) override;
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::uint64_t position_ = 0;
};

}  // namespace lodestir
