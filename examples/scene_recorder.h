// Records the bodies of a world, frame by frame, as a scene file that `carom run FILE --page` plays
// (docs/formats.md): an uncompressed zip archive of NumPy arrays. Of shapes it knows those that the
// rigid bodies of the examples have: spheres, capsules, boxes, half-spaces, hulls and meshes.
#pragma once

#include <carom/carom.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace rigid {

// An archive of arrays, written member by member. Little-endian machines alone.
class ArrayArchive {
 public:
  explicit ArrayArchive(const std::string& path) : file_(path, std::ios::binary) {}

  // `type` as NumPy names it: <f4, <u4, |u1. `shape`: (3,) or (10, 3).
  template <class T>
  void write(const std::string& name, const char* type, const std::string& shape,
             const std::vector<T>& values) {
    std::string header =
        std::string("{'descr': '") + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header.resize((header.size() + 11 + 63) / 64 * 64 - 11, ' ');
    header += '\n';
    std::string member("\x93NUMPY\x01\x00", 8);
    append(member, static_cast<uint16_t>(header.size()));
    member += header;
    member.append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
    write_member(name + ".npy", member);
  }

  // Writes the list of members; whether all went well.
  bool finish() {
    std::string end = "PK\x05\x06" + std::string(4, '\0');
    for (int i = 0; i < 2; ++i) append(end, count_);
    append(end, static_cast<uint32_t>(directory_.size()));
    append(end, offset_);
    append(end, uint16_t{0});
    file_ << directory_ << end;
    file_.close();
    return !file_.fail();
  }

 private:
  template <class T>
  static void append(std::string& text, T number) {
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
  }

  static uint32_t checksum(const std::string& bytes) {
    static const std::array<uint32_t, 256> kTable = [] {
      std::array<uint32_t, 256> table{};
      for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int k = 0; k < 8; ++k) table[i] = table[i] >> 1 ^ (table[i] & 1 ? 0xedb88320u : 0);
      }
      return table;
    }();
    uint32_t sum = ~0u;
    for (const char byte : bytes) sum = kTable[(sum ^ static_cast<uint8_t>(byte)) & 255] ^ sum >> 8;
    return ~sum;
  }

  void write_member(const std::string& name, const std::string& bytes) {
    // What both headers of a member have: version 2.0, no flags, stored, 1980-01-01.
    std::string common;
    for (const uint16_t number : {20, 0, 0, 0, 33}) append(common, number);
    append(common, checksum(bytes));
    for (int i = 0; i < 2; ++i) append(common, static_cast<uint32_t>(bytes.size()));
    append(common, static_cast<uint16_t>(name.size()));
    append(common, uint16_t{0});
    const std::string local = "PK\x03\x04" + common + name;
    directory_ += "PK\x01\x02" + std::string("\x14\x00", 2) + common + std::string(10, '\0');
    append(directory_, offset_);
    directory_ += name;
    file_ << local << bytes;
    offset_ += static_cast<uint32_t>(local.size() + bytes.size());
    ++count_;
  }

  std::ofstream file_;
  std::string directory_;
  uint32_t offset_ = 0;
  uint16_t count_ = 0;
};

class SceneRecorder {
 public:
  // The bodies of the world from now on; none may be added or removed.
  explicit SceneRecorder(const carom::World& world) : world_(world) {
    for (uint32_t i = 0; i < world.size(); ++i) {
      add_shape(world.shape(world.id_of(i)));
      motion_.push_back(static_cast<uint8_t>(world.motion(world.id_of(i))));
    }
  }

  // A pair that never meets; indices of bodies.
  void exclude(uint32_t a, uint32_t b) {
    excluded_.push_back(std::min(a, b));
    excluded_.push_back(std::max(a, b));
  }

  void add_frame() {
    for (uint32_t i = 0; i < world_.size(); ++i) {
      const carom::BodyId id = world_.id_of(i);
      for (const double x : world_.position(id)) position_.push_back(static_cast<float>(x));
      for (const float x : world_.orientation(id).coeffs()) orientation_.push_back(x);
    }
    ++frames_;
  }

  bool write(const std::string& path, double dt) const {
    const std::string bodies = std::to_string(motion_.size());
    const std::string frames = "(" + std::to_string(frames_) + ", " + bodies;
    const auto rows = [](size_t count, int width) {
      return "(" + std::to_string(count / width) + ", " + std::to_string(width) + ")";
    };
    ArrayArchive archive(path);
    archive.write("carom_version", "<i4", "(1,)", std::vector<int32_t>{1});
    archive.write("dt", "<f8", "(1,)", std::vector<double>{dt});
    archive.write("shape_kind", "|u1", "(" + bodies + ",)", kind_);
    archive.write("shape_params", "<f4", rows(params_.size(), 8), params_);
    archive.write("shape_radius", "<f4", "(" + bodies + ",)", radius_);
    archive.write("shape_vertex_range", "<u4", rows(vertex_range_.size(), 2), vertex_range_);
    archive.write("vertices", "<f4", rows(vertices_.size(), 3), vertices_);
    archive.write("shape_triangle_range", "<u4", rows(triangle_range_.size(), 2), triangle_range_);
    archive.write("triangles", "<u4", rows(triangles_.size(), 3), triangles_);
    archive.write("body_shape", "<u4", "(" + bodies + ",)", body_shape_);
    archive.write("body_motion", "|u1", "(" + bodies + ",)", motion_);
    if (!excluded_.empty()) {
      archive.write("excluded_pairs", "<u4", rows(excluded_.size(), 2), excluded_);
    }
    archive.write("position", "<f4", frames + ", 3)", position_);
    archive.write("orientation", "<f4", frames + ", 4)", orientation_);
    return archive.finish();
  }

 private:
  // Every body has a shape of its own in the file; readers store equal ones once.
  void add_shape(const carom::Shape& shape) {
    std::array<float, 8> params{};
    const auto set = [&params](std::initializer_list<float> values) {
      std::copy(values.begin(), values.end(), params.begin());
    };
    const size_t first_vertex = vertices_.size() / 3, first_triangle = triangles_.size() / 3;
    if (const auto* sphere = std::get_if<carom::Sphere>(&shape)) {
      set({sphere->radius});
    } else if (const auto* capsule = std::get_if<carom::Capsule>(&shape)) {
      const auto &a = capsule->a, &b = capsule->b;
      set({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), capsule->radius});
    } else if (const auto* box = std::get_if<carom::Box>(&shape)) {
      set({box->half.x(), box->half.y(), box->half.z()});
    } else if (const auto* plane = std::get_if<carom::Halfspace>(&shape)) {
      set({plane->normal.x(), plane->normal.y(), plane->normal.z(), plane->offset});
    } else if (const auto* hull = std::get_if<carom::Hull>(&shape)) {
      for (const Eigen::Vector3f& point : hull->geometry->points()) add_vertex(point);
    } else if (const auto* mesh = std::get_if<carom::Mesh>(&shape)) {
      const carom::MeshGeometry& geometry = *mesh->geometry;
      set({geometry.rules().one_sided ? 1.0f : 0.0f, geometry.rules().thickness});
      for (size_t i = 0; i < geometry.vertices().size(); ++i) add_vertex(geometry.vertex(i));
      for (size_t i = 0; i < geometry.triangles().size(); ++i) {
        const std::array<uint32_t, 3> triangle = geometry.corner_numbers(i);
        triangles_.insert(triangles_.end(), triangle.begin(), triangle.end());
      }
    }
    // Files have a rounding beside the kind.
    kind_.push_back(static_cast<uint8_t>(carom::core_kind(carom::kind_of(shape))));
    const auto* rounded_box = std::get_if<carom::Box>(&shape);
    const auto* rounded_hull = std::get_if<carom::Hull>(&shape);
    radius_.push_back(rounded_box    ? rounded_box->rounding
                      : rounded_hull ? rounded_hull->rounding
                                     : 0);
    params_.insert(params_.end(), params.begin(), params.end());
    add_range(vertex_range_, first_vertex, vertices_.size() / 3);
    add_range(triangle_range_, first_triangle, triangles_.size() / 3);
    body_shape_.push_back(static_cast<uint32_t>(body_shape_.size()));
  }

  void add_vertex(const Eigen::Vector3f& point) {
    vertices_.insert(vertices_.end(), point.data(), point.data() + 3);
  }

  static void add_range(std::vector<uint32_t>& ranges, size_t first, size_t end) {
    ranges.push_back(static_cast<uint32_t>(first));
    ranges.push_back(static_cast<uint32_t>(end - first));
  }

  const carom::World& world_;
  std::vector<uint8_t> kind_, motion_;
  std::vector<float> params_, radius_, vertices_, position_, orientation_;
  std::vector<uint32_t> excluded_;
  std::vector<uint32_t> vertex_range_, triangle_range_, triangles_, body_shape_;
  size_t frames_ = 0;
};

}  // namespace rigid
