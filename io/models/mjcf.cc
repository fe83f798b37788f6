#include "io/models/mjcf.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "io/files/file.h"
#include "io/models/mjcf_geom.h"
#include "io/models/mjcf_height_field.h"
#include "io/models/mjcf_meetings.h"
#include "io/printable.h"

namespace carom::io {
namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class MjcfReader {
 public:
  explicit MjcfReader(const Xml& mujoco) : files_(mujoco), folder_(folder_of(file_of(mujoco))) {}

  Result<Model> read() {
    if (Result<void> done = files_.read_includes(); !done) return done.error();
    read_sections();
    if (errors_.is_there()) return errors_.error();
    return make_model(bodies_, meetings_, errors_);
  }

 private:
  template <class Visit>
  void for_each_section(std::string_view name, const Visit& visit) {
    files_.for_each_child(files_.main(), [&](const Xml& section) {
      if (section.Name() == name) visit(section);
    });
  }

  // Settings first, whatever the order in the file.
  void read_sections() {
    files_.for_each_child(files_.main(), [this](const Xml& section) {
      if (!is_one_of(section.Name(),
                     {"compiler", "option", "size", "visual", "statistic", "default", "custom",
                      "asset", "worldbody", "contact", "equality", "tendon", "actuator", "sensor",
                      "keyframe", "extension"})) {
        errors_.add(section, "is not supported");
      }
    });
    for_each_section("compiler", [this](const Xml& e) { read_compiler(e, settings_, errors_); });
    for_each_section("option", [this](const Xml& e) { read_option(e); });
    for_each_section("default",
                     [this](const Xml& e) { classes_.read(e, files_, settings_, errors_); });
    for_each_section("asset", [this](const Xml& e) { read_assets(e); });
    bodies_.push_back({.name = "world"});
    for_each_section("worldbody", [this](const Xml& e) { read_children(e, 0, {}, ""); });
    for_each_section("contact", [this](const Xml& e) { read_contacts(e); });
  }

  void read_option(const Xml& option) {
    if (is_one_of(attribute_of(option, "collision"), {"predefined", "dynamic"})) {
      errors_.add(option, "a choice of collisions is not supported");
    }
    files_.for_each_child(option, [this](const Xml& flag) {
      const std::string parents = attribute_of(flag, "filterparent");
      if (!parents.empty()) meetings_.parents_meet_children = parents == "disable";
      if (attribute_of(flag, "contact") == "disable") {
        errors_.add(flag, "switches all contacts off");
      }
    });
  }

  void read_assets(const Xml& asset) {
    files_.for_each_child(asset, [this](const Xml& e) {
      const std::string_view name = e.Name();
      if (name == "mesh") meshes_.add(e, classes_.of(e, "", errors_), errors_);
      if (name == "hfield") height_fields_.add(e, errors_);
    });
  }

  // --- Bodies ---

  Placement placement_of(const Xml& element) {
    Placement placement;
    read_vector(element, "pos", placement.position, errors_);
    placement.orientation = orientation_of(element, settings_, placement.orientation, errors_);
    return placement;
  }

  // Whether a joint lets the body move; frames are parts of the body.
  bool has_joint(const Xml& element) const {
    bool found = false;
    files_.for_each_child(element, [&](const Xml& child) {
      const std::string_view name = child.Name();
      found |= name == "joint" || name == "freejoint" || (name == "frame" && has_joint(child));
    });
    return found;
  }

  // Reads what stands in a body or in a frame of it; `inside` is the frame's place in the body.
  void read_children(const Xml& element, size_t body, const Placement& inside,
                     const std::string& usual_class) {
    const char* own_class = element.Attribute("childclass");
    const std::string of_children = own_class ? own_class : usual_class;
    files_.for_each_child(element, [&](const Xml& child) {
      const std::string_view name = child.Name();
      if (name == "body") {
        read_body(child, body, inside, of_children);
      } else if (name == "frame") {
        expect_attributes(
            child, {"name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"},
            errors_);
        read_children(child, body, inside * placement_of(child), of_children);
      } else if (name == "geom") {
        add_geom(child, body, inside, of_children);
      } else if (!is_one_of(name, {"inertial", "joint", "freejoint", "site", "camera", "light"})) {
        errors_.add(child, "is not supported");
      }
    });
  }

  void read_body(const Xml& element, size_t parent, const Placement& inside,
                 const std::string& usual_class) {
    expect_attributes(element,
                      {"name", "childclass", "mocap", "pos", "quat", "axisangle", "xyaxes", "zaxis",
                       "euler", "gravcomp", "user", "sleep"},
                      errors_);
    const size_t index = bodies_.size();
    MjcfBody body{.element = &element, .name = attribute_of(element, "name"), .parent = parent};
    body.placement = bodies_[parent].placement * inside * placement_of(element);
    body.weld = has_joint(element) ? index : bodies_[parent].weld;
    body.is_mocap = attribute_of(element, "mocap") == "true";
    if (!body.name.empty() && !body_of_.emplace(body.name, index).second) {
      errors_.add(element, "there is another body of this name");
    }
    bodies_.push_back(std::move(body));
    read_children(element, index, {}, usual_class);
  }

  void add_geom(const Xml& element, size_t body, const Placement& inside,
                const std::string& usual_class) {
    MjcfGeom geom = classes_.of(element, usual_class, errors_).geom;
    read_geom(element, settings_, geom, errors_);
    if (meets_nothing(geom)) return;
    MjcfAssets assets;
    if (geom.type == "mesh") {
      assets.mesh = meshes_.get(geom.mesh, folder_, settings_, element, errors_);
    } else if (geom.type == "hfield") {
      assets.heights = height_fields_.get(geom.hfield, folder_, settings_, element, errors_);
    }
    std::optional<ModelShape> shape = shape_of(element, geom, std::move(assets), errors_);
    if (!shape) return;
    shape->placement = inside * shape->placement;
    bodies_[body].geoms.push_back({&element, std::move(*shape), {geom.contype, geom.conaffinity}});
  }

  // --- Pairs ---

  size_t body_named_by(const Xml& element, const char* attribute) {
    const std::string name = attribute_of(element, attribute);
    const auto found = body_of_.find(name);
    if (found != body_of_.end()) return found->second;
    if (name != "world") errors_.add(element, "there is no body " + quoted_name(name));
    return 0;
  }

  void read_contacts(const Xml& contact) {
    files_.for_each_child(contact, [this](const Xml& e) {
      if (std::string_view(e.Name()) != "exclude") {
        return errors_.add(e, "is not supported: only excludes are");
      }
      meetings_.excluded.push_back({body_named_by(e, "body1"), body_named_by(e, "body2")});
    });
  }

  MjcfFiles files_;
  const std::string folder_;
  FirstError errors_;
  MjcfSettings settings_;
  MjcfClasses classes_;
  MjcfMeshes meshes_;
  MjcfHeightFields height_fields_;
  std::vector<MjcfBody> bodies_;  // the world first, parents before children
  std::map<std::string, size_t> body_of_;
  MjcfMeetings meetings_;
};

}  // namespace

Result<Model> read_mjcf(const Xml& mujoco) { return MjcfReader(mujoco).read(); }

}  // namespace carom::io
