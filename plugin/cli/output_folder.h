// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A result folder that appears whole or not at all.

#include <filesystem>
#include <string>
#include <vector>

namespace garmentfit::cli {

class OutputFolder {
public:
    /// Nothing is created yet. @throws InvalidInput when nothing could be: no permission, or a file of that name.
    explicit OutputFolder(const std::filesystem::path& place);
    /// Removes what was not published, and the parents made for it.
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write: a folder beside the final place, on the same disk. Made at the first call.
    const std::filesystem::path& draft();
    /// Moves what was written to the final place. What stands there already and was not written again stays, but for what is
    /// `outdated`: files and folders by their names there.
    void publish(const std::vector<std::string>& outdated);

    const std::filesystem::path& place() const { return place_; }

private:
    std::filesystem::path place_, draft_;
    std::vector<std::filesystem::path> made_parents_;  ///< outermost first
};

}  // namespace garmentfit::cli
