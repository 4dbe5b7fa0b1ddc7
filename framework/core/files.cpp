// SPDX-License-Identifier: MIT
// Reads files whole and writes them aside first, so that no reader ever sees half a file.
#include <framework/core/error.h>
#include <framework/core/file_parts.h>
#include <framework/core/is_file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

/// An open file, closed at the end of its scope.
class File {
public:
    File(const Path& path, int flags) : File(path, flags, path) {}
    /// `known` is the name that people know it by.
    File(const Path& path, int flags, const Path& known) : path_(known), handle_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
    ~File() {
        if (handle_ >= 0) ::close(handle_);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    bool isOpen() const { return handle_ >= 0; }

    /// Gives a file without a name (O_TMPFILE) its first one. False when it can't, errno says why.
    bool name(const Path& name) const {
        const std::string self = "/proc/self/fd/" + std::to_string(handle_);
        return ::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    }

    [[noreturn]] void fail(const char* what, int reason) const {
        throw Error(Where{path_.string()}, std::string(what) + ": " + std::generic_category().message(reason));
    }

    std::size_t size() const {
        struct stat status {};
        if (::fstat(handle_, &status) != 0) fail("cannot be read", errno);
        if (S_ISDIR(status.st_mode)) fail("cannot be read", EISDIR);
        return static_cast<std::size_t>(status.st_size);
    }

    /// Bytes read, 0 at the end.
    std::size_t read(std::span<char> bytes) {
        ssize_t count = 0;
        do count = ::read(handle_, bytes.data(), bytes.size());
        while (count < 0 && errno == EINTR);
        if (count < 0) fail("cannot be read", errno);
        return static_cast<std::size_t>(count);
    }

    void write(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t count = ::write(handle_, bytes.data(), bytes.size());
            if (count < 0 && errno != EINTR) fail("cannot be written", errno);
            if (count > 0) bytes = bytes.subspan(static_cast<std::size_t>(count));
        }
    }

    /// Full disks may only be noticed here.
    void close() {
        if (::close(std::exchange(handle_, -1)) != 0) fail("cannot be written", errno);
    }

private:
    Path path_;
    int handle_;
};

/// A checkout without `git lfs pull` holds small text files in place of models and images; each reader would complain in its own way.
void refuseGitLfsPointer(const Path& path, std::string_view content) {
    if (content.starts_with("version https://git-lfs.github.com/spec/")) {
        throw Error(Where{path.string()}, "is a git-lfs pointer, not the file itself", "fetch with git lfs pull");
    }
}

template <class Bytes> Bytes readWhole(const Path& path) {
    if (path.empty()) throw Error("a file without a name cannot be read");
    std::error_code none;
    const fs::file_status status = fs::status(path, none);
    if (fs::is_character_file(status) || fs::is_block_file(status)) throw Error(Where{path.string()}, "cannot be read: it is a device, which may never end");
    File file(path, O_RDONLY);
    if (!file.isOpen()) file.fail("cannot be read", errno);
    Bytes bytes;
    // One byte more than the size, to meet the end at once; pipes and /proc say 0 and are read in growing steps.
    bytes.resize(file.size() + 1);
    std::size_t used = 0;
    while (const std::size_t count = file.read({reinterpret_cast<char*>(bytes.data()) + used, bytes.size() - used})) {
        used += count;
        if (used == bytes.size()) bytes.resize(2 * bytes.size() + 4096);
    }
    bytes.resize(used);
    refuseGitLfsPointer(path, {reinterpret_cast<const char*>(bytes.data()), used});
    return bytes;
}

void makeFolder(const Path& folder) {
    if (folder.empty()) return;
    std::error_code reason;
    fs::create_directories(folder, reason);
    if (reason) throw Error(Where{folder.string()}, "the folder cannot be made: " + reason.message());
}

/// A name beside the target; it starts with a dot, so that listings and globs pass over it.
Path nameAside(const Path& target, const std::string& mark) {
    return target.parent_path() / ("." + target.stem().string() + "." + mark + target.extension().string());
}

/// Makes an empty file beside the target by a name that no other process or thread has.
Path reserveAside(const Path& target) {
    for (int attempt = 0;; ++attempt) {
        Path aside = nameAside(target, std::to_string(::getpid()) + "-" + std::to_string(attempt));
        if (File(aside, O_WRONLY | O_CREAT | O_EXCL).isOpen()) return aside;
        if (errno != EEXIST) throw Error(Where{target.string()}, "cannot be written: " + std::generic_category().message(errno));
    }
}

/// What a link means is replaced, not the link.
Path followed(const Path& path) {
    std::error_code none;
    const Path end = fs::is_symlink(path, none) ? fs::weakly_canonical(path, none) : path;
    return end.empty() ? path : end;  // a link that leads round in a circle is replaced
}

void replace(const Path& aside, const Path& target) {
    std::error_code reason;
    fs::rename(aside, target, reason);
    if (reason) throw Error(Where{target.string()}, "cannot be written: " + reason.message());
}

/// Devices and pipes such as /dev/null are written to; they must not be renamed over. Error for a folder.
bool isDevice(const Path& target) {
    std::error_code none;
    const fs::file_status status = fs::status(target, none);
    if (fs::is_directory(status)) throw Error(Where{target.string()}, "cannot be written: it is a folder");
    return fs::exists(status) && !fs::is_regular_file(status);
}

/// Writes into a file that has no name until it is whole. Between a name beside the target and the target's own a writer may be killed: that
/// name is one for all writers, so that there is never more than one scrap, and the next writer takes it away. False where the file system has
/// no such files, or where another writer has just taken this one's away.
bool writeNameless(const Path& target, std::span<const std::span<const std::byte>> parts) {
    File file(target.has_parent_path() ? target.parent_path() : Path("."), O_WRONLY | O_TMPFILE, target);
    if (!file.isOpen()) return false;
    for (const auto& part : parts) file.write(part);
    if (file.name(target)) return true;
    const Path aside = nameAside(target, "new");
    while (!file.name(aside))
        if (errno != EEXIST || (::unlink(aside.c_str()) != 0 && errno != ENOENT)) return false;
    if (::rename(aside.c_str(), target.c_str()) == 0) return true;
    ::unlink(aside.c_str());
    return false;
}

}  // namespace

bool isFile(const Path& path) {
    std::error_code none;
    return fs::is_regular_file(path, none);
}

Path namedPath(const Path& folder, const std::string& name) {
    Path literal = folder / name;
    if (name.find('\\') == name.npos || isFile(literal)) return literal;
    std::string slashes = name;
    std::ranges::replace(slashes, '\\', '/');
    Path other = folder / slashes;
    return isFile(other) ? other : literal;
}

std::string readText(const Path& path) { return readWhole<std::string>(path); }

std::vector<std::byte> readBytes(const Path& path) { return readWhole<std::vector<std::byte>>(path); }

struct FileReader::File : lodestir::File {
    using lodestir::File::File;
};

FileReader::FileReader(const Path& path) : file_(std::make_unique<File>(path, O_RDONLY)) {
    if (!file_->isOpen()) file_->fail("cannot be read", errno);
}

FileReader::~FileReader() = default;

std::size_t FileReader::size() const { return file_->size(); }

bool FileReader::read(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const std::size_t count = file_->read({reinterpret_cast<char*>(bytes.data()), bytes.size()});
        if (count == 0) return false;
        bytes = bytes.subspan(count);
    }
    return true;
}

bool isSameFile(const Path& a, const Path& b) {
    std::error_code absent;
    return std::filesystem::equivalent(a, b, absent);
}

void writeAside(const Path& path, const std::function<void(const Path& aside)>& write) {
    const Path target = followed(path);
    if (isDevice(target)) return write(target);
    makeFolder(target.parent_path());
    const Path aside = reserveAside(target);
    try {
        write(aside);
        replace(aside, target);
    } catch (...) {
        std::error_code none;
        fs::remove(aside, none);
        throw;
    }
}

void writeFile(const Path& path, std::span<const std::byte> bytes) { writeParts(path, std::span(&bytes, 1)); }

void writeParts(const Path& path, std::span<const std::span<const std::byte>> parts) {
    const Path target = followed(path);
    if (!isDevice(target)) {
        makeFolder(target.parent_path());
        if (writeNameless(target, parts)) return;
    }
    writeAside(path, [&](const Path& aside) {
        File file(aside, O_WRONLY | O_CREAT | O_TRUNC, path);
        if (!file.isOpen()) file.fail("cannot be written", errno);
        for (const auto& part : parts) file.write(part);
        file.close();
    });
}

void writeFile(const Path& path, std::string_view text) { writeFile(path, std::as_bytes(std::span(text))); }

void writeSealed(const Path& path, std::span<const std::byte> bytes) {
    const Hash content = Hash().add(bytes);
    std::vector<std::byte> file(sizeof content + bytes.size());
    std::memcpy(file.data(), &content, sizeof content);
    std::ranges::copy(bytes, file.begin() + sizeof content);
    writeFile(path, file);
}

std::optional<std::vector<std::byte>> readSealed(const Path& path) {
    if (!isFile(path)) return {};
    std::vector<std::byte> file;
    try {
        file = readBytes(path);
    } catch (const Error&) {
        return {};  // unreadable is as good as missing
    }
    Hash content;
    if (file.size() < sizeof content) return {};
    std::memcpy(&content, file.data(), sizeof content);
    file.erase(file.begin(), file.begin() + sizeof content);
    if (content != Hash().add(file)) return {};
    return file;
}

}  // namespace lodestir
