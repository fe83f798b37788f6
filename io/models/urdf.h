// Robots in URDF: https://wiki.ros.org/urdf/XML.
#pragma once

#include "io/models/model.h"
#include "io/models/xml_file.h"

namespace carom::io {

// The collision shapes of a robot with all joints at zero. A link with shapes is a body. Links that
// a joint joins never meet, nor do links that fixed joints hold together; those that are fixed to a
// link named "world" are static. Cylinders and capsules lie along z, boxes have edges, not half
// edges; a mesh is the surface of its triangles.
// Fails with the line for anything that changes shapes or places and that it does not understand,
// and for links and joints that are no tree.
Result<Model> read_urdf(const Xml& robot);

}  // namespace carom::io
