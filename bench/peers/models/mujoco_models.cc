// carom_mujoco_models FILE.xml...: reads models with Carom and with MuJoCo. Every geom that can
// collide must be there once, in the same place, and the same pairs of geoms may meet.
// scripts/random_mjcf.py writes random models.
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "io/models/read_model.h"

namespace {

using namespace carom;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Metres; MuJoCo keeps vertices in float32 and turns meshes to their axes of inertia.
constexpr double kSamePlace = 2e-5;

// A simple shape of a scene, in the world.
struct PlacedPart {
  uint32_t body, shape;
  Vector3d position;
  Matrix3d turn;
  bool is_taken = false;
};

class CaromModel {
 public:
  explicit CaromModel(const io::Model& model) : info_(model.info) {
    for (uint32_t body = 0; body < info_.bodies; ++body) {
      const io::Placement at = {
          Eigen::Map<const Vector3d>(&model.frame.position64[3 * body]),
          Eigen::Quaternionf(&model.frame.orientation[4 * body]).cast<double>().normalized()};
      add(body, info_.body_shape[body], at);
    }
  }

  std::vector<PlacedPart>& parts() { return parts_; }
  ShapeKind kind(const PlacedPart& part) const {
    return static_cast<ShapeKind>(info_.shapes.kind[part.shape]);
  }
  const std::array<float, 8>& params(const PlacedPart& part) const {
    return info_.shapes.params[part.shape];
  }
  std::vector<Vector3d> vertices(const PlacedPart& part) const {
    std::vector<Vector3d> all;
    const auto [first, count] = info_.shapes.vertex_range[part.shape];
    for (size_t i = first; i < size_t{first} + count; ++i) {
      const Vector3d own = Eigen::Vector3f(info_.shapes.vertices[i].data()).cast<double>();
      all.push_back(part.position + part.turn * own);
    }
    return all;
  }

  bool may_meet(uint32_t a, uint32_t b) const {
    if (a == b) return false;
    if (a > b) std::swap(a, b);
    const auto at = [](const auto& values, uint32_t i, uint32_t usual) {
      return values.empty() ? usual : uint32_t{values[i]};
    };
    const auto layer = [&](uint32_t i) { return at(info_.layer, i, ~0u); };
    const auto mask = [&](uint32_t i) { return at(info_.mask, i, ~0u); };
    const uint32_t owner = at(info_.owner, a, 0);
    const auto& excluded = info_.excluded_pairs;
    return (at(info_.body_motion, a, 2) | at(info_.body_motion, b, 2)) != 0 &&
           (layer(a) & mask(b)) != 0 && (layer(b) & mask(a)) != 0 &&
           (owner == 0 || owner != at(info_.owner, b, 0)) &&
           !std::binary_search(excluded.begin(), excluded.end(), std::array{a, b});
  }

 private:
  void add(uint32_t body, uint32_t shape, const io::Placement& at) {
    const io::SceneShapes& shapes = info_.shapes;
    if (shapes.kind[shape] != static_cast<uint8_t>(ShapeKind::compound)) {
      parts_.push_back({body, shape, at.position, at.orientation.toRotationMatrix()});
      return;
    }
    const auto [first, count] = shapes.child_range[shape];
    for (uint32_t i = first; i < first + count; ++i) {
      const io::Placement inside = {
          Eigen::Vector3f(shapes.child_position[i].data()).cast<double>(),
          Eigen::Quaternionf(shapes.child_orientation[i].data()).cast<double>().normalized()};
      add(body, shapes.child_shape[i], at * inside);
    }
  }

  const io::SceneInfo& info_;
  std::vector<PlacedPart> parts_;
};

class MujocoModel {
 public:
  explicit MujocoModel(const char* path) {
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML(path, nullptr, error.data(), static_cast<int>(error.size())));
    if (!model_) {
      std::fprintf(stderr, "%s: MuJoCo: %s\n", path, error.data());
      return;
    }
    data_.reset(mj_makeData(model_.get()));
    mj_kinematics(model_.get(), data_.get());
  }

  explicit operator bool() const { return model_ != nullptr; }
  int geoms() const { return model_->ngeom; }
  bool collides(int g) const {
    return model_->geom_contype[g] != 0 || model_->geom_conaffinity[g] != 0;
  }

  // How far a part is from being this geom; infinite if it is another kind.
  double difference(int g, const CaromModel& carom, const PlacedPart& part) const {
    const Vector3d at(data_->geom_xpos + 3 * g);
    Matrix3d turn;
    for (int i = 0; i < 9; ++i) turn(i / 3, i % 3) = data_->geom_xmat[9 * g + i];
    const mjtNum* size = model_->geom_size + 3 * g;
    const auto& params = carom.params(part);
    // Axes count in both directions.
    const auto axis = [&](int k) {
      return std::min((part.turn.col(k) - turn.col(k)).norm(),
                      (part.turn.col(k) + turn.col(k)).norm());
    };
    const double moved = (at - part.position).norm();
    const ShapeKind kind = carom.kind(part);
    switch (model_->geom_type[g]) {
      case mjGEOM_SPHERE:
        if (kind == ShapeKind::sphere) return moved + std::fabs(params[0] - size[0]);
        break;
      case mjGEOM_CAPSULE:
        if (kind != ShapeKind::capsule) break;
        return moved + std::fabs(params[6] - size[0]) + std::fabs(params[5] - size[1]) + axis(2);
      case mjGEOM_CYLINDER:
        if (kind != ShapeKind::cylinder) break;
        return moved + std::fabs(params[0] - size[0]) + std::fabs(params[1] - size[1]) + axis(2);
      case mjGEOM_BOX:
      case mjGEOM_ELLIPSOID: {
        const bool is_box = model_->geom_type[g] == mjGEOM_BOX;
        if (kind != (is_box ? ShapeKind::box : ShapeKind::ellipsoid)) break;
        double sum = moved;
        for (int k = 0; k < 3; ++k)
          sum += std::fabs(params[static_cast<size_t>(k)] - size[k]) + axis(k);
        return sum;
      }
      case mjGEOM_PLANE:
        if (kind != ShapeKind::halfspace) break;
        return (part.turn.col(2) - turn.col(2)).norm() +
               std::fabs(turn.col(2).dot(at - part.position));
      case mjGEOM_MESH:
        if (kind == ShapeKind::hull) return furthest_vertex(g, at, turn, carom.vertices(part));
        break;
      default:
        break;
    }
    return std::numeric_limits<double>::infinity();
  }

  // The rules of MuJoCo's documentation, "Collision detection".
  bool may_meet(int g, int h) const {
    const mjModel& m = *model_;
    const bool have_bits = (m.geom_contype[g] & m.geom_conaffinity[h]) != 0 ||
                           (m.geom_contype[h] & m.geom_conaffinity[g]) != 0;
    const int a = m.geom_bodyid[g], b = m.geom_bodyid[h];
    const int weld_a = m.body_weldid[a], weld_b = m.body_weldid[b];
    if (!have_bits || weld_a == weld_b || is_excluded(a, b)) return false;
    const bool are_filtered = (m.opt.disableflags & mjDSBL_FILTERPARENT) == 0;
    const bool are_related = weld_a == m.body_weldid[m.body_parentid[weld_b]] ||
                             weld_b == m.body_weldid[m.body_parentid[weld_a]];
    return !(are_filtered && weld_a != 0 && weld_b != 0 && are_related);
  }
  bool are_planes(int g, int h) const {
    return model_->geom_type[g] == mjGEOM_PLANE && model_->geom_type[h] == mjGEOM_PLANE;
  }

 private:
  struct Deleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  // MuJoCo 2 counts the bodies of excludes from 1.
  bool is_excluded(int a, int b) const {
    const int signature = ((std::min(a, b) + 1) << 16) + std::max(a, b) + 1;
    const int* begin = model_->exclude_signature;
    return std::find(begin, begin + model_->nexclude, signature) != begin + model_->nexclude;
  }

  double furthest_vertex(int g, const Vector3d& at, const Matrix3d& turn,
                         const std::vector<Vector3d>& of_carom) const {
    const int mesh = model_->geom_dataid[g];
    double furthest = 0;
    for (int i = 0; i < model_->mesh_vertnum[mesh]; ++i) {
      const float* v = model_->mesh_vert + 3 * (model_->mesh_vertadr[mesh] + i);
      const Vector3d p = at + turn * Vector3d(v[0], v[1], v[2]);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& q : of_carom) nearest = std::min(nearest, (p - q).norm());
      furthest = std::max(furthest, nearest);
    }
    return furthest;
  }

  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<mjData, Deleter> data_;
};

// The body of each geom; nothing for those that only are seen.
using BodiesOfGeoms = std::vector<std::optional<uint32_t>>;

// Finds the part of each geom, and returns the number of geoms or parts without a partner.
size_t match(const MujocoModel& mujoco, CaromModel& carom, BodiesOfGeoms& bodies) {
  size_t lonely = 0;
  for (int g = 0; g < mujoco.geoms(); ++g) {
    bodies.emplace_back();
    if (!mujoco.collides(g)) continue;
    PlacedPart* best = nullptr;
    double least = kSamePlace;
    for (PlacedPart& part : carom.parts()) {
      const double difference = part.is_taken ? least : mujoco.difference(g, carom, part);
      if (difference < least) best = &part, least = difference;
    }
    if (best == nullptr) {
      ++lonely;
      continue;
    }
    best->is_taken = true;
    bodies.back() = best->body;
  }
  const auto is_free = [](const PlacedPart& part) { return !part.is_taken; };
  return lonely +
         static_cast<size_t>(std::count_if(carom.parts().begin(), carom.parts().end(), is_free));
}

// The number of pairs of geoms that may meet in one and not in the other.
size_t other_pairs(const MujocoModel& mujoco, const CaromModel& carom,
                   const BodiesOfGeoms& bodies) {
  size_t others = 0;
  for (int g = 0; g < mujoco.geoms(); ++g) {
    for (int h = g + 1; h < mujoco.geoms(); ++h) {
      const auto &a = bodies[static_cast<size_t>(g)], &b = bodies[static_cast<size_t>(h)];
      if (!a || !b || mujoco.are_planes(g, h)) continue;
      others += mujoco.may_meet(g, h) != carom.may_meet(*a, *b);
    }
  }
  return others;
}

bool agree(const char* path) {
  const Result<io::Model> model = io::read_model(path);
  if (!model) std::fprintf(stderr, "Carom: %s\n", model.error().message.c_str());
  const MujocoModel mujoco(path);
  if (!model || !mujoco) return !model && !mujoco;
  CaromModel carom(*model);
  BodiesOfGeoms bodies;
  const size_t lonely = match(mujoco, carom, bodies);
  const size_t others = other_pairs(mujoco, carom, bodies);
  if (lonely + others == 0) return true;
  std::printf("%s: %zu geoms in other places, %zu other pairs\n", path, lonely, others);
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  int differing = 0;
  for (int i = 1; i < argc; ++i) differing += !agree(argv[i]);
  std::printf("%d of %d models differ\n", differing, argc - 1);
  return differing > 0 ? 1 : 0;
}
