// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace garmentfit::fixtures {

/// A test with a folder of its own, gone afterwards.
class TemporaryFolder : public testing::Test {
protected:
    void SetUp() override
    {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::path(testing::TempDir())
            / (std::string("garmentfit_") + info->test_suite_name() + "_" + info->name());
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path save(const std::string& name, const std::string& bytes) const
    {
        std::filesystem::remove(folder / name);  // truncating a file makes some file systems wait for the disk
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }

    static std::string load(const std::filesystem::path& path)
    {
        std::ifstream stream(path, std::ios::binary);
        return { std::istreambuf_iterator<char>(stream), {} };
    }

    std::filesystem::path folder;
};

}  // namespace garmentfit::fixtures
