// SPDX-License-Identifier: GPL-3.0-or-later

// Compiled for all processors whatever the rest is compiled for: ends a program that could only crash, with a line that
// says why.

#include "garmentfit/version.h"

#if GARMENTFIT_X86_64_V3

#include <cstdio>
#include <cstdlib>

namespace {

// 101: before all other initialisation of the library
__attribute__((constructor(101))) void require_processor()
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
        return;
    std::fputs("libfit: it was built for processors with AVX2, FMA and BMI2, which this one has not; build it with "
               "-DGARMENTFIT_CPU=baseline\n",
               stderr);
    std::_Exit(1);
}

}  // namespace

#endif
