// SPDX-License-Identifier: GPL-3.0-or-later
// Errors that say which of the scene's garments they are about.
#pragma once

#include <cstddef>
#include <string>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// "coat.obj: "; a garment without a name is "garment 2: " where there are several.
std::string prefix_of(const Scene& scene, std::size_t garment);

/// What work(i) returns; an error names the garment.
template <class Work>
auto for_garment(const Scene& scene, std::size_t i, const Work& work)
{
    try {
        return work(i);
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), prefix_of(scene, i) + error.what());
    } catch (const SolverFailure& error) {
        throw SolverFailure(prefix_of(scene, i) + error.what());
    }
}

/// @throws InvalidInput where a garment is so large or so small that no body as the scene's wears it
void require_wearable_sizes(const Scene& scene);

}  // namespace garmentfit
