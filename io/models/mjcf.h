// Models in MJCF, the format of MuJoCo: https://mujoco.readthedocs.io/en/stable/XMLreference.html.
#pragma once

#include "io/models/model.h"
#include "io/models/xml_file.h"

namespace carom::io {

// The geoms of a model that can collide, in its reference configuration. Every body is a body, a
// compound if it has several geoms; geoms that other bits of contype and conaffinity let meet other
// geoms, planes, and geoms of the world are bodies of their own. Bodies without joints belong to
// the body they are in; what belongs to the world is static, mocap bodies are kinematic. Who may
// meet whom is as in MuJoCo: by contype and conaffinity, not within a body, not a parent and its
// child unless the parent is the world, and not what is excluded.
// Fails with the line for anything that changes shapes, places or pairs and that it does not
// understand, such as height fields.
Result<Model> read_mjcf(const Xml& mujoco);

}  // namespace carom::io
