// SPDX-License-Identifier: GPL-3.0-or-later

// The smallest program that uses the installed package.

#include "garmentfit/skeleton.h"

int main()
{
    const fit::Skeleton at_rest = fit::posed(fit::Skeleton(), fit::Pose());
    return fit::bone_of("lfemur") == fit::lfemur && at_rest.root.isZero() ? 0 : 1;
}
