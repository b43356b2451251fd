// SPDX-License-Identifier: GPL-3.0-or-later

// The smallest program that uses the installed package.

#include "garmentfit/skeleton.h"

int main()
{
    const garmentfit::Skeleton at_rest = garmentfit::pose_skeleton(garmentfit::Skeleton(), garmentfit::Pose());
    return garmentfit::bone_of("lfemur") == garmentfit::lfemur && at_rest.root.isZero() ? 0 : 1;
}
