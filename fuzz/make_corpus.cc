// Writes the seed corpus: make_corpus FOLDER. It wrote the seeds in fuzz/corpus.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/kinds_input.h"
#include "fuzz/points_input.h"
#include "io/pairs_file.h"
#include "io/recording.h"
#include "io/scene.h"
#include "tests/support/composites.h"

namespace {

using namespace carom::io;

// A sphere, a hull, a mesh, a compound of the first two, round shapes and a height field; some
// have a rounding.
SceneShapes all_arrays() {
  SceneShapes shapes;
  shapes.kind = {0, 5, 6, 7, 9, 10, 11, 12};
  shapes.params = {{1}, {}, {}, {}, {1, 2}, {1, 2}, {1, 2, 3}, {2, 2, 1, 1}};
  shapes.vertex_range = {{0, 0}, {0, 4}, {1, 3}};
  shapes.vertex_range.resize(8);
  shapes.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  shapes.triangle_range = {{0, 0}, {0, 0}, {0, 1}};
  shapes.triangle_range.resize(8);
  shapes.triangles = {{0, 1, 2}};
  shapes.child_range = {{0, 0}, {0, 0}, {0, 0}, {0, 2}};
  shapes.child_range.resize(8);
  shapes.child_shape = {0, 1};
  shapes.child_position = {{1, 0, 0}, {0, 1, 0}};
  shapes.child_orientation = {{0, 0, 0, 1}, {0, 0, 0, 1}};
  shapes.height_range.resize(8);
  shapes.height_range[7] = {0, 4};
  shapes.heights = {0, 1, 2, 3};
  shapes.rounding = {0, 0.1f, 0, 0, 0.1f, 0.1f, 0, 0};
  return shapes;
}

bool write_scene(const std::string& path, bool full, Compression compression) {
  SceneInfo info;
  info.bodies = 2;
  info.shapes = all_arrays();
  if (!full) {
    info.shapes = {};
    info.shapes.kind = {0};
    info.shapes.params = {{1}};
  }
  info.body_shape = {0, full ? 3u : 0u};
  info.float64_positions = full;
  info.has_orientation = info.has_linear_velocity = info.has_angular_velocity = full;
  if (full) {
    info.body_motion = {0, 2};
    info.layer = info.mask = {1, 3};
    info.owner = {0, 0};
    info.sensor = {0, 1};
  }
  auto writer = SceneWriter::create(path, info, compression);
  if (!writer) return false;
  SceneFrame frame;
  frame.position32 = {0, 0, 0, 1, 2, 3};
  frame.position64 = {0, 0, 0, 1, 2, 3};
  frame.orientation = {0, 0, 0, 1, 0, 0, 0, 1};
  frame.linear_velocity = frame.angular_velocity = {0, 0, 0, 1, 2, 3};
  return writer->write_frame(frame) && writer->write_frame(frame) && writer->finish();
}

bool write_recording(const std::string& path, size_t frames) {
  auto writer = RecordingWriter::create(path, "seed", "Cubes", 2);
  if (!writer) return false;
  const std::vector<float> boxes = {0, 0, 0, 0, 1, 1, 1, 0, 1, 1, 1, 0, 2, 2, 2, 0};
  for (size_t i = 0; i < frames; ++i) {
    if (!writer->write_frame(boxes)) return false;
  }
  return bool(writer->finish());
}

bool write_seed_pairs(const std::string& path, bool full) {
  PairsFile pairs;
  pairs.shapes = all_arrays();
  pairs.float64_positions = full;
  for (PairSide* side : {&pairs.a, &pairs.b}) {
    side->shape = {0, 1};
    side->position32 = {{0, 0, 0}, {1, 2, 3}};
    if (!full) continue;
    side->position64 = {{0, 0, 0}, {1, 2, 3}};
    side->orientation = {{0, 0, 0, 1}, {0, 0, 0, 1}};
    side->displacement = side->rotation = {{1, 0, 0}, {0, 1, 0}};
  }
  return bool(write_pairs(path, pairs));
}

// A body of about one metre.
carom::fuzz::Body ordinary_body(carom::ShapeKind kind) {
  using namespace carom;
  carom::fuzz::Body body{.rows = {}, .orientation = {0.1f, -0.2f, 0.3f, 0.9f}, .position = {}};
  const std::vector<Eigen::Vector3f> points = {{1, 0, 0}, {-1, 0, 0.5f}, {0, 1, 0}, {0, 0, -1}};
  const auto write = [&](const carom::Shape& shape) { body.rows = shape_rows(shape); };
  switch (kind) {
    case ShapeKind::sphere:
      body.rows[0] = {1};
      break;
    case ShapeKind::aabb:
      body.rows[0] = {-1, -1, -1};
      body.rows[1] = {1, 1, 1};
      break;
    case ShapeKind::capsule:
      write(Capsule{{-1, 0, 0}, {1, 0.5f, 0}, 0.5f});
      break;
    case ShapeKind::box:
      write(Box{{1, 0.7f, 0.4f}});
      break;
    case ShapeKind::rounded_box:
      write(Box{{1, 0.7f, 0.4f}, 0.2f});
      break;
    case ShapeKind::dop:
      write(Dop::of_points(points, DopKind::k14));
      break;
    case ShapeKind::halfspace:
      write(Halfspace{{0, 0.6f, 0.8f}, 0});
      break;
    case ShapeKind::cylinder:
      write(Cylinder{0.7f, 1});
      break;
    case ShapeKind::cone:
      write(Cone{0.8f, 1});
      break;
    case ShapeKind::ellipsoid:
      write(Ellipsoid{{1, 0.7f, 0.4f}});
      break;
    case ShapeKind::hull:
      break;
    case ShapeKind::rounded_hull:
      body.rows[0][3] = 0.2f;
      break;
    default:
      write(Triangle{{points[0], points[1], points[2]}, 0.1f, true, 5});
  }
  return body;
}

// A tetrahedron and a hull of many corners.
void write_hulls(std::ofstream& file) {
  const std::array<float, 12> corners = {1, 0, 0, -1, 0, 0.5f, 0, 1, 0, 0, 0, -1};
  file.put(corners.size() / 3 - 1);
  file.write(reinterpret_cast<const char*>(corners.data()), sizeof corners);
  constexpr uint8_t kOneMetre = 45;
  file.put(static_cast<char>(carom::fuzz::kRandomHull)).put(kOneMetre);
}

void write_kinds(std::ofstream& file, uint8_t pair, uint8_t flags,
                 const std::array<double, 3>& way) {
  const auto& kinds = carom::fuzz::kPairs[pair];
  std::array<carom::fuzz::Body, 2> bodies = {ordinary_body(kinds.a), ordinary_body(kinds.b)};
  bodies[1].position = way;
  file.put(static_cast<char>(pair)).put(static_cast<char>(flags));
  file.write(reinterpret_cast<const char*>(bodies.data()), sizeof bodies);
  const auto is_hull = [](carom::ShapeKind kind) {
    return carom::core_kind(kind) == carom::ShapeKind::hull;
  };
  const bool has_hull = is_hull(kinds.a) || is_hull(kinds.b);
  if (has_hull) write_hulls(file);
}

// Calls write(file, pair) with a new file for every pair of kinds.
template <class Write>
bool write_all_kinds(const std::string& folder, const Write& write) {
  for (uint8_t pair = 0; pair < std::size(carom::fuzz::kPairs); ++pair) {
    const auto& kinds = carom::fuzz::kPairs[pair];
    const std::string file_name = std::string(carom::name(kinds.a)) + "_" + carom::name(kinds.b);
    std::ofstream file(folder + file_name, std::ios::binary);
    write(file, pair);
    if (!file.flush()) return false;
  }
  return true;
}

void write_pair(std::ofstream& file, uint8_t pair) {
  write_kinds(file, pair, pair % 4, {0.7, 0.9, -0.4});
}

// B comes from some metres away; its rotation counts if the flags of the pair say so.
void write_motion(std::ofstream& file, uint8_t pair) {
  write_kinds(file, pair, pair % 8, {3.5, 4.5, -2});
  const std::array<int16_t, 6> stays = {0, 0, 0, 2000, 0, 0};
  const std::array<int16_t, 6> comes = {-13000, -16000, 7000, 0, 5000, -3000};
  file.write(reinterpret_cast<const char*>(stays.data()), sizeof stays);
  file.write(reinterpret_cast<const char*>(comes.data()), sizeof comes);
}

// Random bytes; they make numbers of a metre or less.
void put_random(std::ofstream& file, carom::oracle::Random& random, size_t bytes) {
  while (bytes-- > 0) file.put(static_cast<char>(random.bits()));
}

// A cloud of this family; odd families are turned and moved. Thin ones are a 1000th as thin as
// wide.
void put_cloud(std::ofstream& file, carom::oracle::Random& random, uint8_t family, size_t points) {
  const uint8_t place = family % 2 ? 3 : 0;
  file.put(static_cast<char>(family)).put(static_cast<char>(place));
  if (place != 0) put_random(file, random, 4 + 6);
  file.put(10);
  put_random(file, random, points * 6);
}

// Two hulls of 17 points of a family. In half of the files both are the same hull; in the others
// they touch.
bool write_hull_pair(const std::string& path, uint8_t family) {
  constexpr uint8_t kCount = 128;
  carom::oracle::Random random(family);
  std::ofstream file(path, std::ios::binary);
  const bool is_same = family % 4 < 2;
  file.put(static_cast<char>(is_same ? 2 : 8));
  for (int hull = 0; hull < (is_same ? 1 : 2); ++hull) {
    file.put(static_cast<char>(kCount)).put(0);
    put_cloud(file, random, family, 17);
  }
  put_random(file, random, 4 + 4 + 6);
  return bool(file.flush());
}

bool write_all_hulls(const std::string& folder) {
  for (uint8_t family = 0; family < static_cast<uint8_t>(carom::fuzz::Family::count); ++family) {
    if (!write_hull_pair(folder + "family_" + std::to_string(family), family)) return false;
  }
  return true;
}

void put_simple(std::ofstream& file, carom::oracle::Random& random) {
  file.put(0);
  put_random(file, random, 8);
}

// Six triangles over eight points.
void put_mesh(std::ofstream& file, carom::oracle::Random& random) {
  file.put(0).put(8).put(6);
  put_random(file, random, 6 * 3);
  put_cloud(file, random, static_cast<uint8_t>(carom::fuzz::Family::box), 8);
}

// A sphere, a box, a mesh.
void put_compound(std::ofstream& file, carom::oracle::Random& random) {
  using carom::ShapeKind;
  file.put(3);
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::box, ShapeKind::mesh}) {
    file.put(static_cast<char>(kind));
    kind == ShapeKind::mesh ? put_mesh(file, random) : put_simple(file, random);
    put_random(file, random, 6 + 4);
  }
}

void put_shape(std::ofstream& file, carom::oracle::Random& random, carom::ShapeKind kind) {
  if (kind == carom::ShapeKind::mesh) return put_mesh(file, random);
  if (kind == carom::ShapeKind::compound) return put_compound(file, random);
  put_simple(file, random);
}

bool write_composites(const std::string& path, uint8_t pair,
                      const std::array<carom::ShapeKind, 2>& kinds) {
  carom::oracle::Random random(pair);
  std::ofstream file(path, std::ios::binary);
  file.put(static_cast<char>(pair)).put(0).put(0);
  for (const carom::ShapeKind kind : kinds) put_shape(file, random, kind);
  put_random(file, random, 6 + 4 + 4);
  return bool(file.flush());
}

bool write_all_composites(const std::string& folder) {
  const auto kinds = carom::test::composite_kind_pairs();
  for (uint8_t pair = 0; pair < kinds.size(); ++pair) {
    const std::string name =
        std::string(carom::name(kinds[pair][0])) + "_" + carom::name(kinds[pair][1]);
    if (!write_composites(folder + name, pair, kinds[pair])) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_corpus FOLDER\n");
    return 2;
  }
  const std::string folder = std::string(argv[1]) + "/";
  for (const char* kind : {"recording_fuzz", "scene_fuzz", "pairs_fuzz", "kinds_fuzz",
                           "motions_fuzz", "hull_fuzz", "composites_fuzz"}) {
    std::filesystem::create_directories(folder + kind);
  }
  const bool done = write_scene(folder + "scene_fuzz/small.npz", false, Compression::kStored) &&
                    write_scene(folder + "scene_fuzz/full.npz", true, Compression::kStored) &&
                    write_scene(folder + "scene_fuzz/deflated.npz", true, Compression::kDeflated) &&
                    write_recording(folder + "recording_fuzz/one.aabb", 1) &&
                    write_recording(folder + "recording_fuzz/three.aabb", 3) &&
                    write_seed_pairs(folder + "pairs_fuzz/small.npz", false) &&
                    write_seed_pairs(folder + "pairs_fuzz/full.npz", true) &&
                    write_all_kinds(folder + "kinds_fuzz/", write_pair) &&
                    write_all_kinds(folder + "motions_fuzz/", write_motion) &&
                    write_all_hulls(folder + "hull_fuzz/") &&
                    write_all_composites(folder + "composites_fuzz/");
  if (!done) std::fprintf(stderr, "the corpus could not be written\n");
  return done ? 0 : 1;
}
