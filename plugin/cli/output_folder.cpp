// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_folder.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <unistd.h>

#include "garmentfit/error.h"

namespace garmentfit::cli {
namespace {

namespace fs = std::filesystem;

constexpr int k_attempts = 10;  // unit: a file may come while the folder is emptied

fs::path without_trailing_slash(const fs::path& path)
{
    const fs::path normal = fs::absolute(path).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

fs::path nearest_existing(fs::path path)
{
    while (!fs::exists(path) && path.has_relative_path())
        path = path.parent_path();
    return path;
}

void require_writable(const fs::path& place)
{
    const fs::path ground = nearest_existing(place);
    if (!fs::is_directory(ground))
        throw InvalidInput(ErrorCode::unwritable_file,
                           ground.string() + ": a file, not a folder; give another folder with -o");
    // the draft is a folder beside the final one, so the parent must be writable, too
    for (const fs::path& folder : { ground, nearest_existing(place.parent_path()) })
        if (access(folder.c_str(), W_OK | X_OK) != 0)
            throw InvalidInput(ErrorCode::unwritable_file,
                               folder.string() + ": cannot be written to (" + std::strerror(errno)
                                   + "); give another folder with -o");
}

std::vector<fs::path> make_parents(const fs::path& folder)
{
    std::vector<fs::path> made;
    for (fs::path path = folder; !fs::exists(path); path = path.parent_path())
        made.insert(made.begin(), path);
    for (const fs::path& path : made)
        fs::create_directory(path);
    return made;
}

void move_into(const fs::path& from, const fs::path& to)
{
    for (const fs::directory_entry& entry : fs::directory_iterator(from)) {
        const fs::path target = to / entry.path().filename();
        if (fs::is_directory(target))
            fs::remove_all(target);
        fs::rename(entry.path(), target);
    }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& place) : place_(without_trailing_slash(place)) { require_writable(place_); }

OutputFolder::~OutputFolder() { abandon(); }

void OutputFolder::abandon() const
{
    std::error_code ignored;
    for (int attempt = 0; attempt < k_attempts && !draft_.empty() && fs::exists(draft_, ignored); ++attempt)
        fs::remove_all(draft_, ignored);
    for (auto parent = made_parents_.rbegin(); parent != made_parents_.rend(); ++parent)
        fs::remove(*parent, ignored);  // only where empty
}

const fs::path& OutputFolder::draft()
{
    if (!draft_.empty())
        return draft_;
    made_parents_ = make_parents(place_.parent_path());
    draft_ = place_.string() + ".unfinished-" + std::to_string(getpid());
    fs::create_directory(draft_);
    return draft_;
}

void OutputFolder::publish(const std::vector<std::string>& outdated)
{
    if (!fs::exists(place_)) {
        fs::rename(draft(), place_);
        return;
    }
    std::vector<fs::path> leaving;
    for (const std::string& name : outdated)
        if (!fs::exists(draft() / name))
            leaving.push_back(place_ / name);
    move_into(draft(), place_);
    for (const fs::path& path : leaving)
        fs::remove_all(path);
}

}  // namespace garmentfit::cli
