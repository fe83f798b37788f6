// The bodies of an MJCF model as bodies of a scene that meet as they do in MuJoCo.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/models/model.h"
#include "io/models/xml_file.h"

namespace carom::io {

// contype and conaffinity. Two geoms meet if a bit of one's contype is in the other's conaffinity.
using MjcfBits = std::array<uint32_t, 2>;

struct MjcfBodyGeom {
  const Xml* element;
  ModelShape shape;
  MjcfBits bits;
};

struct MjcfBody {
  const Xml* element = nullptr;  // of the world: nullptr
  std::string name;
  size_t parent = 0;
  size_t weld = 0;  // the body that it moves with: itself, or the nearest above that has joints
  bool is_mocap = false;
  Placement placement{};  // in the world
  std::vector<MjcfBodyGeom> geoms{};
};

struct MjcfMeetings {
  bool parents_meet_children = false;
  std::vector<std::array<size_t, 2>> excluded;  // bodies
};

// The first body is the world. Carom's layers and masks ask for a bit of each of two bodies in the
// other, MuJoCo for one of the two; so every combination of bits that the geoms have becomes a
// layer. Fails if there are more than 32.
Result<Model> make_model(const std::vector<MjcfBody>& bodies, const MjcfMeetings& meetings,
                         FirstError& errors);

}  // namespace carom::io
