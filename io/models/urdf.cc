#include "io/models/urdf.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "io/files/file.h"
#include "io/models/mesh_library.h"
#include "io/printable.h"

namespace carom::io {
namespace {

using Eigen::Vector3d;

constexpr size_t kNone = ~size_t{0};

// Fixed axes: first about x, then y, then z.
Eigen::Quaterniond orientation_from(const Vector3d& roll_pitch_yaw) {
  return (Eigen::AngleAxisd(roll_pitch_yaw.z(), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(roll_pitch_yaw.y(), Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_pitch_yaw.x(), Vector3d::UnitX()))
      .normalized();
}

struct UrdfLink {
  const Xml* element;
  std::vector<ModelShape> shapes{};
  size_t parent = kNone;
  size_t rigid = kNone;   // the first link of those that fixed joints hold together
  Placement placement{};  // in the parent's frame, then in the world
  bool is_fixed = false;  // to its parent
  bool is_placed = false;
  std::vector<size_t> children{};
};

class UrdfReader {
 public:
  explicit UrdfReader(const Xml& robot) : robot_(robot), folder_(folder_of(file_of(robot))) {}

  Result<Model> read() {
    if (robot_.FirstChildElement("xacro:macro") != nullptr ||
        robot_.FirstChildElement("xacro:include") != nullptr) {
      return xml_error(robot_, "holds macros (run it through xacro first)");
    }
    for_each(robot_, "link", [this](const Xml& link) { read_link(link); });
    for_each(robot_, "joint", [this](const Xml& joint) { read_joint(joint); });
    if (links_.empty()) errors_.add(robot_, "has no link");
    if (!errors_.is_there()) place_links();
    if (errors_.is_there()) return errors_.error();
    return make_model();
  }

 private:
  template <class Visit>
  static void for_each(const Xml& parent, const char* name, const Visit& visit) {
    for (const Xml* e = parent.FirstChildElement(name); e; e = e->NextSiblingElement(name)) {
      visit(*e);
    }
  }

  // --- Links ---

  void read_link(const Xml& element) {
    const std::string name = attribute_of(element, "name");
    if (name.empty()) errors_.add(element, "has no name");
    if (!link_of_.emplace(name, links_.size()).second) {
      errors_.add(element, "there is another link of this name");
    }
    links_.push_back({.element = &element});
    for_each(element, "collision", [this](const Xml& collision) { read_collision(collision); });
  }

  void read_collision(const Xml& element) {
    const Xml* geometry = element.FirstChildElement("geometry");
    const Xml* shape = geometry ? geometry->FirstChildElement() : nullptr;
    if (shape == nullptr) return errors_.add(element, "has no geometry");
    if (shape->NextSiblingElement()) errors_.add(element, "has more than one shape");
    ModelShape read;
    if (!read_shape(*shape, read)) return;
    read.placement = origin_of(element);
    links_.back().shapes.push_back(std::move(read));
  }

  Placement origin_of(const Xml& element) {
    Placement placement;
    const Xml* origin = element.FirstChildElement("origin");
    if (origin == nullptr) return placement;
    expect_attributes(*origin, {"xyz", "rpy"}, errors_);
    read_vector(*origin, "xyz", placement.position, errors_);
    Vector3d angles = Vector3d::Zero();
    read_vector(*origin, "rpy", angles, errors_);
    placement.orientation = orientation_from(angles);
    return placement;
  }

  // A number that is there and not negative.
  float length_of(const Xml& element, const char* attribute) {
    const std::vector<double> numbers = numbers_of(element, attribute, 1, 1, errors_);
    if (!numbers.empty() && numbers[0] >= 0) return static_cast<float>(numbers[0]);
    errors_.add(element, std::string(attribute) + " is missing or negative");
    return 0;
  }

  bool read_shape(const Xml& element, ModelShape& shape) {
    const std::string kind = element.Name();
    expect_attributes(element, {"radius", "length", "size", "filename", "scale"}, errors_);
    if (kind == "sphere") {
      shape.kind = ShapeKind::sphere;
      shape.params = {length_of(element, "radius")};
    } else if (kind == "cylinder") {
      shape.kind = ShapeKind::cylinder;
      shape.params = {length_of(element, "radius"), length_of(element, "length") / 2};
    } else if (kind == "capsule") {
      const float radius = length_of(element, "radius"), half = length_of(element, "length") / 2;
      shape.kind = ShapeKind::capsule;
      shape.params = {0, 0, -half, 0, 0, half, radius};
    } else if (kind == "box") {
      read_box(element, shape);
    } else if (kind == "mesh") {
      read_mesh(element, shape);
    } else {
      errors_.add(element, "is no shape that is known (box, cylinder, sphere, capsule or mesh)");
    }
    return !errors_.is_there();
  }

  void read_box(const Xml& element, ModelShape& shape) {
    Vector3d edges(-1, -1, -1);
    read_vector(element, "size", edges, errors_);
    if (!(edges.minCoeff() >= 0)) errors_.add(element, "size is missing or negative");
    shape.kind = ShapeKind::box;
    for (int axis = 0; axis < 3; ++axis) shape.params[axis] = static_cast<float>(edges[axis] / 2);
  }

  void read_mesh(const Xml& element, ModelShape& shape) {
    const std::string name = attribute_of(element, "filename");
    const std::string path = resolve_file(folder_, name);
    Vector3d scale = Vector3d::Ones();
    read_vector(element, "scale", scale, errors_);
    if (scale.prod() == 0) errors_.add(element, "scale is zero along an axis");
    if (name.empty()) errors_.add(element, "has no filename");
    if (path.empty()) {
      errors_.add(element, "no folder from here upwards has the file of " + quoted_name(name));
    }
    if (errors_.is_there()) return;
    shape.kind = ShapeKind::mesh;
    shape.mesh = meshes_.read(path, scale, element, errors_);
  }

  // --- Joints ---

  size_t link_named_by(const Xml& joint, const char* side) {
    const Xml* element = joint.FirstChildElement(side);
    const std::string name = element ? attribute_of(*element, "link") : "";
    const auto found = link_of_.find(name);
    if (found != link_of_.end()) return found->second;
    errors_.add(joint, std::string(side) + " is " + quoted_name(name) + ", which is no link");
    return kNone;
  }

  void read_joint(const Xml& element) {
    const size_t parent = link_named_by(element, "parent");
    const size_t child = link_named_by(element, "child");
    if (parent == kNone || child == kNone) return;
    UrdfLink& link = links_[child];
    if (link.parent != kNone) {
      errors_.add(element, "its child " + quoted_name(attribute_of(*link.element, "name")) +
                               " is the child of another joint");
      return;
    }
    const std::string type = attribute_of(element, "type");
    constexpr std::string_view kTypes[] = {"fixed",     "revolute", "continuous",
                                           "prismatic", "floating", "planar"};
    if (std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes)) {
      errors_.add(element, "is of the unknown type " + quoted_name(type));
    }
    link.parent = parent;
    link.is_fixed = type == "fixed";
    link.placement = origin_of(element);
    links_[parent].children.push_back(child);
  }

  // Parents first, so that each link finds its parent in the world.
  void place_links() {
    std::vector<size_t> next;
    for (size_t i = links_.size(); i-- > 0;) {
      if (links_[i].parent == kNone) next.push_back(i);
    }
    if (next.size() > 1) {
      errors_.add(*links_[next[next.size() - 2]].element,
                  "no joint has this link as its child, but "
                  "there is another such link before it");
    }
    while (!next.empty()) {
      const size_t index = next.back();
      next.pop_back();
      UrdfLink& link = links_[index];
      link.is_placed = true;
      link.rigid = link.is_fixed ? links_[link.parent].rigid : index;
      if (link.parent != kNone) link.placement = links_[link.parent].placement * link.placement;
      next.insert(next.end(), link.children.rbegin(), link.children.rend());
    }
    for (const UrdfLink& link : links_) {
      if (!link.is_placed) errors_.add(*link.element, "is part of a loop of joints");
    }
  }

  // --- The scene ---

  bool is_static(const UrdfLink& link) const {
    return attribute_of(*links_[link.rigid].element, "name") == "world";
  }

  Model make_model() const {
    ModelBuilder builder;
    std::vector<size_t> bodies(links_.size(), kNone);
    for (size_t i = 0; i < links_.size(); ++i) {
      const UrdfLink& link = links_[i];
      if (link.shapes.empty()) continue;
      bodies[i] = builder.add({.name = attribute_of(*link.element, "name"),
                               .placement = link.placement,
                               .motion = is_static(link) ? Motion::fixed : Motion::dynamic,
                               .owner = static_cast<uint32_t>(link.rigid + 1),
                               .shapes = link.shapes});
    }
    // Parents may come later in the file.
    for (size_t i = 0; i < links_.size(); ++i) {
      const size_t parent = links_[i].parent;
      if (parent == kNone || bodies[i] == kNone || bodies[parent] == kNone) continue;
      builder.exclude(static_cast<uint32_t>(bodies[i]), static_cast<uint32_t>(bodies[parent]));
    }
    return builder.finish();
  }

  const Xml& robot_;
  const std::string folder_;
  FirstError errors_;
  MeshLibrary meshes_;
  std::vector<UrdfLink> links_;
  std::map<std::string, size_t> link_of_;
};

}  // namespace

Result<Model> read_urdf(const Xml& robot) { return UrdfReader(robot).read(); }

}  // namespace carom::io
