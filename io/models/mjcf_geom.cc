#include "io/models/mjcf_geom.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "io/files/file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

using Eigen::Vector3d;

uint32_t read_bits(const Xml& element, const char* attribute, uint32_t usual, FirstError& errors) {
  const std::vector<double> numbers = numbers_of(element, attribute, 1, 1, errors);
  if (numbers.empty()) return usual;
  const double value = numbers[0];
  if (value != std::floor(value) || value < -0x1p31 || value >= 0x1p32) {
    errors.add(element, std::string(attribute) + " is no whole number of 32 bits");
    return usual;
  }
  return static_cast<uint32_t>(static_cast<int64_t>(value));
}

void read_size(const Xml& element, MjcfGeom& geom, FirstError& errors) {
  const std::vector<double> size = numbers_of(element, "size", 0, 3, errors);
  std::copy(size.begin(), size.end(), geom.size.begin());
}

void read_ends(const Xml& element, MjcfGeom& geom, FirstError& errors) {
  const std::vector<double> ends = numbers_of(element, "fromto", 6, 6, errors);
  if (!ends.empty()) std::copy(ends.begin(), ends.end(), geom.ends.emplace().begin());
}

bool is_long(const std::string& type) { return type == "capsule" || type == "cylinder"; }

// Turns the ends of a geom into its place and length.
void apply_ends(const Xml& element, MjcfGeom& geom, FirstError& errors) {
  if (!geom.ends) return;
  const auto& e = *geom.ends;
  const Vector3d from(e[0], e[1], e[2]), to(e[3], e[4], e[5]);
  const double half = (to - from).norm() / 2;
  const bool has_edges = geom.type == "box" || geom.type == "ellipsoid";
  if (!has_edges && !is_long(geom.type)) {
    errors.add(element, "fromto needs a capsule, cylinder, box or ellipsoid");
  }
  if (!(half > 0)) errors.add(element, "the ends of fromto are one point");
  if (!geom.placement.position.isZero(0)) errors.add(element, "has both pos and fromto");
  if (errors.is_there()) return;
  if (has_edges) {
    geom.size[1] = geom.size[0];
    geom.size[2] = half;
  } else {
    geom.size[1] = half;
  }
  geom.placement = {from + (to - from) / 2, turn_from_z(from - to)};
}

// How many numbers of its size a type needs; they must be above 0.
size_t sizes_of(const std::string& type) {
  if (type == "sphere") return 1;
  if (is_long(type)) return 2;
  return type == "box" || type == "ellipsoid" ? 3 : 0;
}

void set_kind(const MjcfGeom& geom, ModelShape& shape) {
  const auto x = static_cast<float>(geom.size[0]), y = static_cast<float>(geom.size[1]),
             z = static_cast<float>(geom.size[2]);
  if (geom.type == "capsule") {
    shape.kind = ShapeKind::capsule;
    shape.params = {0, 0, -y, 0, 0, y, x};
  } else if (geom.type == "plane") {
    shape.kind = ShapeKind::halfspace;
    shape.params = {0, 0, 1, 0};
  } else {
    shape.kind = geom.type == "cylinder"    ? ShapeKind::cylinder
                 : geom.type == "ellipsoid" ? ShapeKind::ellipsoid
                 : geom.type == "box"       ? ShapeKind::box
                                            : ShapeKind::sphere;
    shape.params = {x, y, z};
    std::fill(shape.params.begin() + static_cast<std::ptrdiff_t>(sizes_of(geom.type)),
              shape.params.end(), 0.0f);
  }
}

}  // namespace

void read_geom(const Xml& element, const MjcfSettings& settings, MjcfGeom& geom,
               FirstError& errors) {
  expect_attributes(
      element,
      {"name",     "class",        "type",       "contype",   "conaffinity", "condim", "group",
       "priority", "size",         "material",   "rgba",      "friction",    "mass",   "density",
       "solmix",   "shellinertia", "solref",     "solimp",    "margin",      "gap",    "fromto",
       "pos",      "quat",         "axisangle",  "xyaxes",    "zaxis",       "euler",  "hfield",
       "mesh",     "fitscale",     "fluidshape", "fluidcoef", "user"},
      errors);
  if (const char* type = element.Attribute("type")) geom.type = type;
  if (const char* mesh = element.Attribute("mesh")) geom.mesh = mesh;
  if (const char* hfield = element.Attribute("hfield")) geom.hfield = hfield;
  geom.contype = read_bits(element, "contype", geom.contype, errors);
  geom.conaffinity = read_bits(element, "conaffinity", geom.conaffinity, errors);
  read_size(element, geom, errors);
  read_ends(element, geom, errors);
  read_vector(element, "pos", geom.placement.position, errors);
  geom.placement.orientation =
      orientation_of(element, settings, geom.placement.orientation, errors);
}

// --- Classes ---

void MjcfClasses::read(const Xml& section, const MjcfFiles& files, const MjcfSettings& settings,
                       FirstError& errors) {
  read_class(section, "", files, settings, errors);
  const std::string name = attribute_of(section, "class");
  classes_[name.empty() ? "main" : name] = classes_[""];
}

void MjcfClasses::read_class(const Xml& element, const std::string& name, const MjcfFiles& files,
                             const MjcfSettings& settings, FirstError& errors) {
  MjcfClass& own = classes_[name];
  files.for_each_child(element, [&](const Xml& child) {
    const std::string of = child.Name();
    if (of == "geom") read_geom(child, settings, own.geom, errors);
    if (of == "mesh") read_vector(child, "scale", own.mesh_scale, errors);
  });
  files.for_each_child(element, [&](const Xml& child) {
    if (std::string_view(child.Name()) != "default") return;
    const std::string nested = attribute_of(child, "class");
    if (nested.empty()) return errors.add(child, "has no class");
    if (!classes_.emplace(nested, own).second) {
      return errors.add(child, "there is another class " + quoted_name(nested));
    }
    read_class(child, nested, files, settings, errors);
  });
}

const MjcfClass& MjcfClasses::of(const Xml& element, const std::string& usual,
                                 FirstError& errors) const {
  const char* given = element.Attribute("class");
  const std::string name = given ? given : usual;
  const auto found = classes_.find(name);
  if (found != classes_.end()) return found->second;
  errors.add(element, "there is no class " + quoted_name(name));
  return classes_.at("");
}

// --- Meshes ---

void MjcfMeshes::add(const Xml& element, const MjcfClass& defaults, FirstError& errors) {
  expect_attributes(element,
                    {"name", "class", "file", "vertex", "normal", "texcoord", "face",
                     "content_type", "maxhullvert", "refpos", "refquat", "scale", "smoothnormal",
                     "inertia", "octree_maxdepth", "material"},
                    errors);
  if (element.FirstChildElement()) errors.add(element, "has children, which are not understood");
  std::string name = attribute_of(element, "name");
  if (name.empty()) name = stem_of(attribute_of(element, "file"));
  Asset asset{&element, defaults.mesh_scale, nullptr};
  read_vector(element, "scale", asset.scale, errors);
  if (asset.scale.prod() == 0) errors.add(element, "scale is zero along an axis");
  if (!assets_.emplace(name, asset).second) {
    errors.add(element, "there is another mesh " + quoted_name(name));
  }
}

std::shared_ptr<const ModelMesh> MjcfMeshes::get(const std::string& name,
                                                 const std::filesystem::path& folder,
                                                 const MjcfSettings& settings, const Xml& geom,
                                                 FirstError& errors) {
  const auto found = assets_.find(name);
  if (found == assets_.end()) {
    errors.add(geom, "there is no mesh " + quoted_name(name));
    return nullptr;
  }
  Asset& asset = found->second;
  if (asset.mesh == nullptr) asset.mesh = read(asset, folder, settings, errors);
  return asset.mesh;
}

std::shared_ptr<const ModelMesh> MjcfMeshes::read(const Asset& asset,
                                                  const std::filesystem::path& folder,
                                                  const MjcfSettings& settings,
                                                  FirstError& errors) {
  const Xml& element = *asset.element;
  auto mesh = std::make_shared<ModelMesh>();
  if (const std::string file = attribute_of(element, "file"); !file.empty()) {
    std::filesystem::path path = file;
    if (settings.strips_paths) path = path.filename();
    const auto whole = library_.read((folder / (settings.mesh_folder / path)).string(),
                                     Vector3d::Ones(), element, errors);
    if (whole == nullptr) return nullptr;
    *mesh = *whole;
  } else {
    const std::vector<double> numbers = numbers_of(element, "vertex", 3, ~size_t{0}, errors);
    if (numbers.empty() || numbers.size() % 3 != 0) {
      errors.add(element, "has neither a file nor vertices of three numbers each");
      return nullptr;
    }
    for (size_t i = 0; i < numbers.size(); i += 3) {
      mesh->vertices.push_back({static_cast<float>(numbers[i]), static_cast<float>(numbers[i + 1]),
                                static_cast<float>(numbers[i + 2])});
    }
  }
  move_vertices(asset, *mesh, errors);
  return mesh;
}

// The vertices in the reference frame of the asset, scaled.
void MjcfMeshes::move_vertices(const Asset& asset, ModelMesh& mesh, FirstError& errors) {
  Vector3d origin = Vector3d::Zero();
  read_vector(*asset.element, "refpos", origin, errors);
  const std::vector<double> q = numbers_of(*asset.element, "refquat", 4, 4, errors);
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  if (!q.empty()) turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  if (!(turn.norm() > 0)) return errors.add(*asset.element, "refquat is zero");
  if (!origin.isZero(0) || !q.empty()) {
    for (std::array<float, 3>& v : mesh.vertices) {
      const Vector3d moved = turn.normalized().conjugate() * (Vector3d(v[0], v[1], v[2]) - origin);
      v = {static_cast<float>(moved.x()), static_cast<float>(moved.y()),
           static_cast<float>(moved.z())};
    }
  }
  scale_mesh(mesh, asset.scale);
}

// --- Shapes ---

std::optional<ModelShape> shape_of(const Xml& element, const MjcfGeom& given, MjcfAssets assets,
                                   FirstError& errors) {
  MjcfGeom geom = given;
  apply_ends(element, geom, errors);
  ModelShape shape;
  if (geom.type == "mesh") {
    shape.kind = ShapeKind::hull;
    shape.mesh = std::move(assets.mesh);
    if (shape.mesh == nullptr) return std::nullopt;
  } else if (geom.type == "hfield") {
    if (assets.heights == nullptr) return std::nullopt;
    shape.kind = ShapeKind::height_field;
    shape.params = assets.heights->params;
    shape.heights = std::move(assets.heights);
  } else if (geom.type != "plane" && sizes_of(geom.type) == 0) {
    errors.add(element, "the type " + quoted_name(geom.type) +
                            " is not supported (plane, hfield, sphere, capsule, ellipsoid, "
                            "cylinder, box and mesh are)");
  } else if (!geom.mesh.empty()) {
    errors.add(element, "a " + geom.type + " fitted to a mesh is not supported");
  } else {
    set_kind(geom, shape);
  }
  for (size_t i = 0; i < sizes_of(geom.type); ++i) {
    if (!(geom.size[i] > 0)) errors.add(element, "size must be above 0");
  }
  shape.placement = geom.placement;
  if (errors.is_there()) return std::nullopt;
  return shape;
}

}  // namespace carom::io
