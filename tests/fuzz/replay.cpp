// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzz target on files that are kept, and on some inputs made of them, with any compiler.
//   replay FOLDER|FILE... [--mangled N]
// N inputs more are the files with random bytes changed, always the same ones.
#include <algorithm>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz_target.h"

namespace {

std::vector<std::filesystem::path> files_in(const std::filesystem::path& given)
{
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(given)) {
        for (const auto& entry : std::filesystem::directory_iterator(given))
            if (entry.is_regular_file())
                files.push_back(entry.path());
    } else {
        files.push_back(given);
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string bytes_of(const std::filesystem::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    garmentfit::fuzz::require(bool(stream), "that a file can be read");
    return { std::istreambuf_iterator<char>(stream), {} };
}

void run(const std::string& bytes)
{
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::string mangled(std::string bytes, std::mt19937& random)
{
    for (unsigned changes = 1 + random() % 4; changes > 0 && !bytes.empty(); --changes)
        bytes[random() % bytes.size()] = char(random());
    return random() % 4 == 0 ? bytes.substr(0, random() % (bytes.size() + 1)) : bytes;
}

}  // namespace

int main(int count, char** arguments)
{
    std::vector<std::string> kept;
    int more = 0;
    for (int i = 1; i < count; ++i)
        if (std::string_view(arguments[i]) == "--mangled" && i + 1 < count)
            more = std::atoi(arguments[++i]);
        else
            for (const std::filesystem::path& path : files_in(arguments[i])) {
                std::printf("%s\n", path.filename().c_str());
                std::fflush(stdout);
                kept.push_back(bytes_of(path));
                run(kept.back());
            }
    garmentfit::fuzz::require(!kept.empty(), "that there are files");
    std::mt19937 random(23);
    for (int i = 0; i < more; ++i)
        run(mangled(kept[random() % kept.size()], random));
    std::printf("%zu files and %d more inputs\n", kept.size(), more);
}
