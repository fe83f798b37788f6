#include "io/models/mjcf_meetings.h"

#include <algorithm>
#include <map>

namespace carom::io {
namespace {

bool may_meet(const MjcfBits& a, const MjcfBits& b) { return (a[0] & b[1]) || (b[0] & a[1]); }

// A layer for every combination of bits.
class MjcfLayers {
 public:
  void add(const MjcfBodyGeom& geom, FirstError& errors) {
    if (std::find(combinations_.begin(), combinations_.end(), geom.bits) != combinations_.end()) {
      return;
    }
    if (combinations_.size() == 32) {
      errors.add(*geom.element,
                 "is the 33rd combination of contype and conaffinity (at most 32 are supported)");
      return;
    }
    combinations_.push_back(geom.bits);
  }

  uint32_t layer(const MjcfBits& bits) const {
    const auto place = std::find(combinations_.begin(), combinations_.end(), bits);
    return meet_all() ? ~0u : 1u << (place - combinations_.begin());
  }

  uint32_t mask(const MjcfBits& bits) const {
    if (meet_all()) return ~0u;
    uint32_t mask = 0;
    for (const MjcfBits& other : combinations_) {
      if (may_meet(bits, other)) mask |= layer(other);
    }
    return mask;
  }

 private:
  bool meet_all() const {
    return combinations_.size() == 1 && may_meet(combinations_[0], combinations_[0]);
  }

  std::vector<MjcfBits> combinations_;
};

class MjcfSceneMaker {
 public:
  MjcfSceneMaker(const std::vector<MjcfBody>& bodies, const MjcfLayers& layers)
      : bodies_(bodies), layers_(layers), made_(bodies.size()) {}

  Model make(const MjcfMeetings& meetings) {
    for (size_t i = 0; i < bodies_.size(); ++i) add_body(i);
    for (const auto& [a, b] : meetings.excluded) exclude(made_[a], made_[b]);
    if (!meetings.parents_meet_children) exclude_parents();
    return builder_.finish();
  }

 private:
  using Indices = std::vector<uint32_t>;

  // Adds the geoms that can be one body of the scene as one.
  void add_body(size_t index) {
    const MjcfBody& body = bodies_[index];
    std::map<MjcfBits, ModelBody> together;
    for (const MjcfBodyGeom& geom : body.geoms) {
      ModelBody alone = body_with(index, geom);
      if (index == 0 || geom.shape.kind == ShapeKind::halfspace) {
        add(index, alone);
        continue;
      }
      const auto [known, is_new] = together.emplace(geom.bits, alone);
      if (!is_new) known->second.shapes.push_back(geom.shape);
    }
    for (const auto& [bits, made] : together) add(index, made);
  }

  ModelBody body_with(size_t index, const MjcfBodyGeom& geom) const {
    const MjcfBody& body = bodies_[index];
    const Motion motion = body.is_mocap    ? Motion::kinematic
                          : body.weld == 0 ? Motion::fixed
                                           : Motion::dynamic;
    const std::string of_geom = attribute_of(*geom.element, "name");
    return {.name = index == 0 || body.name.empty() ? of_geom : body.name,
            .placement = body.placement,
            .motion = motion,
            .owner = static_cast<uint32_t>(body.weld + 1),
            .layer = layers_.layer(geom.bits),
            .mask = layers_.mask(geom.bits),
            .shapes = {geom.shape}};
  }

  void add(size_t index, const ModelBody& body) { made_[index].push_back(builder_.add(body)); }

  void exclude(const Indices& of_a, const Indices& of_b) {
    for (const uint32_t a : of_a) {
      for (const uint32_t b : of_b) {
        if (a != b) builder_.exclude(a, b);
      }
    }
  }

  // A body and the one it is in do not meet, nor do those that are rigidly joined to them.
  void exclude_parents() {
    std::vector<Indices> rigid(bodies_.size());
    for (size_t i = 0; i < bodies_.size(); ++i) {
      Indices& all = rigid[bodies_[i].weld];
      all.insert(all.end(), made_[i].begin(), made_[i].end());
    }
    for (size_t i = 1; i < bodies_.size(); ++i) {
      const size_t parent = bodies_[bodies_[i].parent].weld;
      if (bodies_[i].weld == i && parent != 0) exclude(rigid[i], rigid[parent]);
    }
  }

  const std::vector<MjcfBody>& bodies_;
  const MjcfLayers& layers_;
  std::vector<Indices> made_;  // of each body, its bodies in the scene
  ModelBuilder builder_;
};

}  // namespace

Result<Model> make_model(const std::vector<MjcfBody>& bodies, const MjcfMeetings& meetings,
                         FirstError& errors) {
  MjcfLayers layers;
  for (const MjcfBody& body : bodies) {
    for (const MjcfBodyGeom& geom : body.geoms) {
      layers.add(geom, errors);
      if (geom.shape.kind == ShapeKind::halfspace && body.weld != 0) {
        errors.add(*geom.element, "is a plane on a body that moves");
      }
    }
  }
  if (errors.is_there()) return errors.error();
  return MjcfSceneMaker(bodies, layers).make(meetings);
}

}  // namespace carom::io
