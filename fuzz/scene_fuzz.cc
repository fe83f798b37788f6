// Reads any bytes as a scene archive. An accepted scene must have arrays that fit each other.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz/memory_file.h"
#include "io/scene.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_info(const carom::io::SceneInfo& info) {
  require(info.frames > 0 && info.body_shape.size() == info.bodies);
  require(info.body_motion.empty() || info.body_motion.size() == info.bodies);
  require(info.sensor.empty() || info.sensor.size() == info.bodies);
  for (const uint32_t shape : info.body_shape) require(shape < info.shapes.kind.size());
  for (const auto& [first, count] : info.shapes.vertex_range) {
    require(uint64_t{first} + count <= info.shapes.vertices.size());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const carom::fuzz::MemoryFile file(data, size);
  auto scene = carom::io::open_scene(file.path());
  if (!scene) return 0;
  const carom::io::SceneInfo& info = (*scene)->info();
  check_info(info);
  carom::io::SceneFrame frame;
  const uint64_t frames = info.frames < 100 ? info.frames + 1 : 100;
  for (uint64_t i = 0; i < frames; ++i) {
    if (!(*scene)->read_frame(frame)) break;
    require(frame.position32.size() + frame.position64.size() == info.bodies * 3);
    require(frame.orientation.size() == (info.has_orientation ? info.bodies * 4 : 0));
  }
  return 0;
}
