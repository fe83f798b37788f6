// Geoms and meshes of MJCF: their attributes, the defaults of classes, and the shapes they are.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "io/models/mesh_library.h"
#include "io/models/mjcf_settings.h"

namespace carom::io {

// The attributes of a geom that matter to collision.
struct MjcfGeom {
  std::string type = "sphere";
  std::array<double, 3> size{};
  Placement placement;
  std::optional<std::array<double, 6>> ends;  // "fromto"
  uint32_t contype = 1, conaffinity = 1;      // two geoms meet if a bit of one is in the other's
  std::string mesh, hfield;                   // names of assets
};

// A class of defaults for geoms and meshes.
struct MjcfClass {
  MjcfGeom geom;
  Eigen::Vector3d mesh_scale = Eigen::Vector3d::Ones();
};

class MjcfClasses {
 public:
  // Reads a top-level default section. Classes inherit from those around them.
  void read(const Xml& section, const MjcfFiles& files, const MjcfSettings& settings,
            FirstError& errors);

  // The class that the element names, or else `usual` (a name, "" for the outermost).
  const MjcfClass& of(const Xml& element, const std::string& usual, FirstError& errors) const;

 private:
  void read_class(const Xml& element, const std::string& name, const MjcfFiles& files,
                  const MjcfSettings& settings, FirstError& errors);

  std::map<std::string, MjcfClass> classes_ = {{"", {}}, {"main", {}}};
};

// Overwrites what the element gives.
void read_geom(const Xml& element, const MjcfSettings& settings, MjcfGeom& geom,
               FirstError& errors);

// Whether it is there to be seen alone.
inline bool meets_nothing(const MjcfGeom& geom) {
  return geom.contype == 0 && geom.conaffinity == 0;
}

class MjcfMeshes {
 public:
  // Notes a mesh of an asset section; files are read when a geom needs them.
  void add(const Xml& element, const MjcfClass& defaults, FirstError& errors);
  // The mesh of this name for a geom; nullptr on failure.
  std::shared_ptr<const ModelMesh> get(const std::string& name, const std::filesystem::path& folder,
                                       const MjcfSettings& settings, const Xml& geom,
                                       FirstError& errors);

 private:
  struct Asset {
    const Xml* element;
    Eigen::Vector3d scale;
    std::shared_ptr<const ModelMesh> mesh;  // once it is read
  };
  std::shared_ptr<const ModelMesh> read(const Asset& asset, const std::filesystem::path& folder,
                                        const MjcfSettings& settings, FirstError& errors);
  static void move_vertices(const Asset& asset, ModelMesh& mesh, FirstError& errors);

  std::map<std::string, Asset> assets_;
  MeshLibrary library_;
};

// Geoms of these types share them.
struct MjcfAssets {
  std::shared_ptr<const ModelMesh> mesh;
  std::shared_ptr<const ModelHeights> heights;
};

// The shape of a geom; of a mesh its convex hull, as MuJoCo has it. Nothing on failure.
std::optional<ModelShape> shape_of(const Xml& element, const MjcfGeom& geom, MjcfAssets assets,
                                   FirstError& errors);

}  // namespace carom::io
