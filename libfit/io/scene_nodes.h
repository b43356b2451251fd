// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <assimp/scene.h>

namespace garmentfit {

/// Calls `visitor` with a node of an Assimp scene and all below it, parents first.
template <class Node, class Visitor>
void visit_nodes(Node& node, const Visitor& visitor)
{
    visitor(node);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        visit_nodes<Node>(*node.mChildren[i], visitor);
}

}  // namespace garmentfit
