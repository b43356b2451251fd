// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A result folder that appears when it is complete, or not at all.

#include <filesystem>
#include <string>
#include <vector>

namespace garmentfit::cli {

class OutputFolder {
public:
    /// Creates nothing yet. @throws InvalidInput where nothing can be created: no permission, or a file of that name.
    explicit OutputFolder(const std::filesystem::path& place);
    /// Removes what was not published, and the parent folders made for it.
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write: a folder beside the final one, on the same disk. Made at the first call.
    const std::filesystem::path& draft();
    /// Moves what was written to the final folder. Other files there stay, except those that are `outdated` (names of
    /// files and folders) and were not written again.
    void publish(const std::vector<std::string>& outdated);
    /// What the destructor does, for a process that ends without it: also while somebody still writes there.
    void abandon() const;

    const std::filesystem::path& place() const { return place_; }

private:
    std::filesystem::path place_, draft_;
    std::vector<std::filesystem::path> made_parents_;  ///< outermost first
};

}  // namespace garmentfit::cli
