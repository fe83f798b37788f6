// Gives nodes of packed trees the boxes of their children.
#pragma once

#include <cstddef>
#include <span>

#include "trees/tree.h"

namespace carom {

// The children of the nodes are boxes[child], or boxes[child - kItem] if they are items. The first
// `children` places of the nodes, taken one after another, have children; the others stay as they
// are, with NaN for ends. Writes the box of all children of each node to node_boxes, and returns
// the sum of their areas.
double fit_nodes(std::span<BoxTree::Node> nodes, size_t children, const TreeBox* boxes,
                 TreeBox* node_boxes);

}  // namespace carom
