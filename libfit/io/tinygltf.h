// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// tinygltf without its reader of pictures. Its functions are compiled in the library of that name, so nobody defines
// TINYGLTF_IMPLEMENTATION.

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
