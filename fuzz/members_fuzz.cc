// Reads any bytes as the members of an intact archive. Random changes of a whole archive would
// break its checksums; here they are right, so that the code behind them is reached.
//
// The input is a list of members: one byte selects the name, two bytes the length, then content.
#include <zip.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "fuzz/memory_file.h"
#include "io/pairs_file.h"
#include "io/scene.h"

namespace {

constexpr const char* kNames[] = {
    "carom_version.npy",
    "shape_kind.npy",
    "shape_params.npy",
    "body_shape.npy",
    "position.npy",
    "orientation.npy",
    "linear_velocity.npy",
    "angular_velocity.npy",
    "dt.npy",
    "shape_vertex_range.npy",
    "vertices.npy",
    "shape_triangle_range.npy",
    "triangles.npy",
    "shape_child_range.npy",
    "child_shape.npy",
    "child_position.npy",
    "body_motion.npy",
    "child_orientation.npy",
    "pair_shape_a.npy",
    "pair_shape_b.npy",
    "position_a.npy",
    "position_b.npy",
    "orientation_a.npy",
    "displacement_b.npy",
    "rotation_a.npy",
    "body_sensor.npy",
    "shape_height_range.npy",
    "heights.npy",
    "excluded_pairs.npy",
};

// The uncompressed archive in memory.
std::vector<uint8_t> archive_of(const uint8_t* data, size_t size) {
  zip_source_t* target = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  zip_source_keep(target);
  zip_t* archive = zip_open_from_source(target, ZIP_TRUNCATE, nullptr);
  for (size_t i = 0; i + 3 <= size;) {
    const char* name = kNames[data[i] % std::size(kNames)];
    size_t length = data[i + 1] | size_t{data[i + 2]} << 8;
    i += 3;
    if (length > size - i) length = size - i;
    zip_source_t* content = zip_source_buffer(archive, data + i, length, 0);
    const zip_int64_t index = zip_file_add(archive, name, content, 0);
    if (index < 0) zip_source_free(content);  // the name exists already
    if (index >= 0) {
      zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_STORE, 0);
    }
    i += length;
  }
  std::vector<uint8_t> bytes;
  if (zip_close(archive) != 0) std::abort();
  zip_stat_t status;
  if (zip_source_stat(target, &status) == 0 && (status.valid & ZIP_STAT_SIZE) &&
      zip_source_open(target) == 0) {
    bytes.resize(status.size);
    zip_source_read(target, bytes.data(), bytes.size());
    zip_source_close(target);
  }
  zip_source_free(target);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::vector<uint8_t> bytes = archive_of(data, size);
  const carom::fuzz::MemoryFile file(bytes.data(), bytes.size());
  (void)carom::io::read_pairs(file.path());
  auto scene = carom::io::open_scene(file.path());
  if (!scene) return 0;
  carom::io::SceneFrame frame;
  for (int i = 0; i < 3; ++i) {
    if (!(*scene)->read_frame(frame)) break;
  }
  return 0;
}
