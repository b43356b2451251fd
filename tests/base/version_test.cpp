// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/version.h"

#include <string>

#include <gtest/gtest.h>

namespace garmentfit {

TEST(Version, OfTheLibraryIsThatOfItsHeaders)
{
    const std::string numbers = std::to_string(GARMENTFIT_VERSION_MAJOR) + '.'
        + std::to_string(GARMENTFIT_VERSION_MINOR) + '.' + std::to_string(GARMENTFIT_VERSION_PATCH);
    EXPECT_EQ(library_version(), numbers);
}

}  // namespace garmentfit
