#include "cli/page/scene_view.h"

#include <nlohmann/json.hpp>
#include <set>

#include "cli/page/shape_view.h"
#include "cli/page/surface_check.h"
#include "cli/support/statistics.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;

template <class Numbers>
void append(const Numbers& numbers, Json& column) {
  for (const float number : numbers) column.push_back(shortest(number));
}

std::set<uint32_t> left_out_of(const World& world) {
  std::set<uint32_t> bodies;
  for (const BodyId id : world.quarantined()) bodies.insert(id.index);
  return bodies;
}

struct BodyColumns {
  Json index = Json::array();
  Json shape = Json::array();
  Json motion = Json::array();
  Json position = Json::array();     // three numbers a body, in metres
  Json orientation = Json::array();  // four numbers a body

  void add(const World& world, BodyId id, ShapeTable& shapes) {
    index.push_back(id.index);
    shape.push_back(shapes.add(world.shape(id)));
    motion.push_back(static_cast<int>(world.motion(id)));
    for (const double coordinate : world.position(id)) position.push_back(coordinate);
    append(world.orientation(id).coeffs(), orientation);
  }

  Json json() && {
    return {{"index", std::move(index)},
            {"shape", std::move(shape)},
            {"motion", std::move(motion)},
            {"position", std::move(position)},
            {"orientation", std::move(orientation)}};
  }
};

Json bodies_of(const World& world, ShapeTable& shapes) {
  const std::set<uint32_t> left_out = left_out_of(world);
  BodyColumns columns;
  for (uint32_t i = 0; i < world.size(); ++i) {
    if (!left_out.contains(i)) columns.add(world, world.id_of(i), shapes);
  }
  return std::move(columns).json();
}

// Points are relative to the position of A. At detail contact the only point is the witness point.
struct ContactColumns {
  Json a = Json::array();
  Json b = Json::array();
  Json separation = Json::array();
  Json normal = Json::array();  // three numbers a contact
  Json arm_a = Json::array();
  Json arm_b = Json::array();
  Json points = Json::array();  // number of points of each contact
  Json point = Json::array();   // three numbers a point
  Json point_separation = Json::array();

  void add(const Contact& contact) {
    a.push_back(contact.a);
    b.push_back(contact.b);
    separation.push_back(shortest(contact.separation));
    append(contact.normal, normal);
    append(contact.arm_a, arm_a);
    append(contact.arm_b, arm_b);
  }

  void add_witness(const Contact& contact) {
    points.push_back(1);
    append(contact.arm_a, point);
    point_separation.push_back(shortest(contact.separation));
  }

  void add_manifold(size_t count, const ManifoldPoints& manifold) {
    points.push_back(count);
    for (size_t i = 0; i < count; ++i) {
      append(manifold.point[i], point);
      point_separation.push_back(shortest(manifold.separation[i]));
    }
  }

  Json json() && {
    return {{"a", std::move(a)},
            {"b", std::move(b)},
            {"separation", std::move(separation)},
            {"normal", std::move(normal)},
            {"arm_a", std::move(arm_a)},
            {"arm_b", std::move(arm_b)},
            {"points", std::move(points)},
            {"point", std::move(point)},
            {"point_separation", std::move(point_separation)}};
  }
};

Json contacts_of(const World& world) {
  ContactColumns columns;
  for (size_t i = 0; i < world.contacts().size(); ++i) {
    const Contact& contact = world.contacts()[i];
    columns.add(contact);
    if (has_manifolds(world.settings().detail)) {
      columns.add_manifold(contact.manifold_count, world.manifolds()[i]);
    } else {
      columns.add_witness(contact);
    }
  }
  return std::move(columns).json();
}

Json summary_of(const SurfaceDistances& distances) {
  return {{"points", distances.metres.size()},
          {"median", median(distances.metres)},
          {"greatest", distances.greatest},
          {"furthest_contact", distances.furthest_contact}};
}

Json surface_of(const World& world) {
  const SurfaceCheck check = check_surfaces(world);
  return {{"on", summary_of(check.on)},
          {"across", summary_of(check.across)},
          {"left_out", check.left_out}};
}

Json shapes_of(ShapeTable& shapes) {
  Json views = Json::array();
  for (size_t i = 0; i < shapes.size(); ++i) views.push_back(view_of(shapes[i], shapes));
  return views;
}

// RFC 4648.
std::string base64(const std::vector<float>& numbers) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = reinterpret_cast<const uint8_t*>(numbers.data());
  const size_t count = numbers.size() * sizeof(float);
  std::string text;
  for (size_t i = 0; i < count; i += 3) {
    const auto byte = [&](size_t k) { return k < count ? uint32_t{bytes[k]} : 0; };
    const uint32_t three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (const int shift : {18, 12, 6, 0}) text += kDigits[three >> shift & 63];
  }
  const size_t padding = (3 - count % 3) % 3;
  return text.replace(text.size() - padding, padding, padding, '=');
}

// Poses are float32, little endian, in base64.
Json track_of(const MotionTrack& track, double dt) {
  const Eigen::Vector3d& origin = track.origin();
  return {{"dt", dt},
          {"frame", track.frames()},
          {"body", track.bodies()},
          {"origin", {origin.x(), origin.y(), origin.z()}},
          {"pose", base64(track.poses())}};
}

}  // namespace

std::string view_of(const World& world, const std::string& scene, uint64_t frame,
                    const MotionTrack& track, double dt) {
  ShapeTable shapes;
  Json view = {{"scene", scene}, {"frame", frame}};
  view["left_out"] = world.quarantined().size();
  view["detail"] = has_manifolds(world.settings().detail) ? "manifold" : "contact";
  view["body"] = bodies_of(world, shapes);
  view["shapes"] = shapes_of(shapes);
  view["contact"] = contacts_of(world);
  view["surface"] = surface_of(world);
  view["track"] = track_of(track, dt);
  return view.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace carom::cli
