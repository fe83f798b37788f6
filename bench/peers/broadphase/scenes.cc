#include "bench/peers/broadphase/scenes.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "io/recording.h"

namespace carom::bench {
namespace {

constexpr size_t kMostFrames = 64;  // read from a recording

static_assert(sizeof(Box) == io::kFloatsPerBox * sizeof(float));

Box box_at(const BoundsView& bounds, size_t i) {
  return {{bounds.lower[0][i], bounds.lower[1][i], bounds.lower[2][i], 0},
          {bounds.upper[0][i], bounds.upper[1][i], bounds.upper[2][i], 0}};
}

void grow(Box& box, const Box& other) {
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
    box.upper[axis] = std::max(box.upper[axis], other.upper[axis]);
  }
}

}  // namespace

PeerScene::PeerScene(const SceneSpec& spec) : name_(spec.name()) {
  const Frames frames(spec);
  for (size_t i = 0; i < Frames::kCount; ++i) {
    const std::vector<PlacedShape> bodies = frames.bodies(i);
    const DenseBodies arrays(spec.kind, bodies, Storage::f32);
    BoundsArrays bounds(spec.bodies);
    compute_bounds(arrays.view(), bounds.columns());
    std::vector<Box> boxes;
    for (size_t row = 0; row < spec.bodies; ++row) boxes.push_back(box_at(bounds.view(), row));
    add_frame(std::move(boxes));
  }
}

Result<PeerScene> PeerScene::open(const std::string& path) {
  Result<io::RecordingReader> reader = io::RecordingReader::open(path);
  if (!reader) return reader.error();
  const io::RecordingInfo& info = reader->info();
  if (info.frames < 2 || info.bodies == 0) {
    return Error{path + ": at least two frames of one box are needed"};
  }
  PeerScene scene(std::filesystem::path(path).filename().string());
  std::vector<float> values;
  while (scene.boxes_.size() < std::min<size_t>(info.frames, kMostFrames)) {
    if (const Result<void> read = reader->read_frame(values); !read) return read.error();
    std::vector<Box> boxes(info.bodies);
    std::memcpy(boxes.data(), values.data(), values.size() * sizeof(float));
    scene.add_frame(std::move(boxes));
  }
  return scene;
}

void PeerScene::add_frame(std::vector<Box> boxes) {
  if (boxes_.empty()) world_ = boxes.front();
  const BoundsColumns columns = columns_.emplace_back(boxes.size()).columns();
  for (size_t i = 0; i < boxes.size(); ++i) {
    grow(world_, boxes[i]);
    for (size_t axis = 0; axis < 3; ++axis) {
      columns.lower[axis][i] = boxes[i].lower[axis];
      columns.upper[axis][i] = boxes[i].upper[axis];
    }
  }
  boxes_.push_back(std::move(boxes));
}

FrameBounds PeerScene::frame(size_t i) const {
  const BoundsView columns = columns_[i].view();
  return {boxes_[i], columns.lower, columns.upper};
}

}  // namespace carom::bench
