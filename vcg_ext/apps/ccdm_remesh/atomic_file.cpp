// SPDX-License-Identifier: GPL-3.0-or-later
#include "atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace ccdm_remesh {
namespace {

namespace fs = std::filesystem;

// Where a chain of symbolic links leads, even if there is no file yet.
fs::path Destination(fs::path path)
{
    std::error_code error;
    for (int k = 0; k < 40 && fs::is_symlink(path, error); ++k) {
        const fs::path next = fs::read_symlink(path, error);
        if (error)
            break;
        path = path.parent_path() / next;
    }
    return path;
}

bool IsDevice(const fs::path &path)
{
    std::error_code ignored;
    return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
}

// A file that is being written.
class Output
{
public:
    Output() = default;
    ~Output()
    {
        if (_file != nullptr)
            std::fclose(_file);
        std::error_code ignored;
        if (_temporary)
            fs::remove(_path, ignored);
    }
    Output(const Output &) = delete;
    Output &operator=(const Output &) = delete;

    bool Open(const fs::path &path)
    {
        _path = path;
        _file = std::fopen(path.string().c_str(), "wb");
        return _file != nullptr;
    }

    // Opens a new file beside the target, which is removed in the end unless it is renamed. A name is taken where
    // another run writes to it, or was killed while it did: where many have been, the oldest gives way.
    bool OpenBeside(const fs::path &target)
    {
        const std::string name = "." + target.filename().string().substr(0, LongestName) + ".part";
        for (int attempt = 0; attempt < 2; ++attempt) {
            fs::path oldest;
            fs::file_time_type time;
            for (int k = 0; k < MostLeft; ++k) {
                _path = target.parent_path() / (name + std::to_string(k));
                _file = std::fopen(_path.string().c_str(), "wbx");
                _temporary = _file != nullptr;
                if (_temporary)
                    return true;
                if (errno != EEXIST)
                    return false;
                std::error_code ignored;
                const fs::file_time_type t = fs::last_write_time(_path, ignored);
                if (oldest.empty() || t < time) {
                    oldest = _path;
                    time = t;
                }
            }
            std::error_code ignored;
            fs::remove(oldest, ignored);
        }
        return false;
    }

    // Returns what went wrong.
    std::string Write(const std::string &content)
    {
        errno = 0;
        const bool written = std::fwrite(content.data(), 1, content.size(), _file) == content.size();
        int error = errno;
        const bool closed = std::fclose(_file) == 0;
        _file = nullptr;
        if (written && closed)
            return "";
        error = written ? errno : error;
        return "it could not be written to its end" +
               (error == 0 ? std::string() : ": " + std::generic_category().message(error));
    }

    std::string Rename(const fs::path &target)
    {
        std::error_code error;
        fs::rename(_path, target, error);
        _temporary = static_cast<bool>(error);
        return error ? error.message() : "";
    }

private:
    static constexpr int MostLeft = 8;
    static constexpr std::size_t LongestName = 200; // file systems allow 255 bytes

    fs::path _path;
    std::FILE *_file = nullptr;
    bool _temporary = false;
};

} // namespace

bool IsSameFile(const std::string &a, const std::string &b)
{
    std::error_code error;
    if (fs::equivalent(a, b, error))
        return true;
    const auto full = [&](const std::string &path) {
        return fs::weakly_canonical(fs::absolute(Destination(path), error), error);
    };
    const fs::path whole = full(a);
    return !whole.empty() && whole == full(b);
}

std::string FindWriteFault(const std::string &path)
{
    if (IsDevice(path))
        return "";
    const fs::path target = Destination(path);
    std::error_code ignored;
    if (fs::is_directory(target, ignored))
        return "it is a folder";
    const fs::path folder = target.parent_path().empty() ? "." : target.parent_path();
    if (!fs::is_directory(folder, ignored))
        return "its folder does not exist";
    return Output().OpenBeside(target) ? "" : "no file can be made in its folder";
}

std::string WriteAtomically(const std::string &path, const std::string &content)
{
    const bool device = IsDevice(path);
    const fs::path target = device ? fs::path(path) : Destination(path);
    Output output;
    if (!(device ? output.Open(target) : output.OpenBeside(target)))
        return device ? "it cannot be opened" : "no file can be made in its folder";
    const std::string fault = output.Write(content);
    return fault.empty() && !device ? output.Rename(target) : fault;
}

} // namespace ccdm_remesh
