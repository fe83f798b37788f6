// Reads any bytes as a model, URDF or MJCF. An accepted model must be a scene that its own checks
// pass, with numbers and unit quaternions in it.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "fuzz/memory_file.h"
#include "io/models/read_model.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void check_model(const carom::io::Model& model) {
  const carom::io::SceneInfo& info = model.info;
  require(bool(carom::io::check_scene(info, "model")));
  require(model.shape_names.size() == info.shapes.kind.size());
  require(model.frame.position64.size() == 3 * info.bodies);
  require(model.frame.orientation.size() == 4 * info.bodies);
  for (const double x : model.frame.position64) require(std::isfinite(x));
  for (size_t i = 0; i < info.bodies; ++i) {
    const float* q = &model.frame.orientation[4 * i];
    const float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    require(std::fabs(square - 1) < 1e-5f);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const carom::fuzz::MemoryFile file(data, size);
  const auto model = carom::io::read_model(file.path());
  if (model) check_model(*model);
  return 0;
}
