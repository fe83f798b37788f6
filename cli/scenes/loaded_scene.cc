#include "cli/scenes/loaded_scene.h"

#include <algorithm>
#include <utility>

#include "cli/scenes/scene_source.h"

namespace carom::cli {
namespace {

template <class T>
size_t bytes_of(const std::vector<T>& list) {
  return list.size() * sizeof(T);
}

size_t bytes_of_frame(const io::SceneFrame& frame) {
  return bytes_of(frame.position32) + bytes_of(frame.position64) + bytes_of(frame.orientation) +
         bytes_of(frame.linear_velocity) + bytes_of(frame.angular_velocity) + bytes_of(frame.boxes);
}

}  // namespace

Result<std::unique_ptr<LoadedScene>> LoadedScene::open(const std::string& source,
                                                       bool looks_ahead) {
  Result<std::unique_ptr<io::SceneReader>> scene = open_source(source);
  if (!scene) return scene.error();
  Result<Player> player = Player::create((*scene)->info(), source);
  if (!player) return player.error();
  (*scene)->want(player->wanted(Detail::contact, looks_ahead));
  std::unique_ptr<LoadedScene> loaded(
      new LoadedScene(source, std::move(*scene), std::move(*player)));
  if (Result<void> read = loaded->load(1); !read) return read.error();
  return loaded;
}

Result<void> LoadedScene::load(size_t frames, size_t bytes) {
  size_t most = std::min<uint64_t>(frames, info().frames);
  if (!frames_.empty()) {
    most = std::min(most, bytes / std::max<size_t>(1, bytes_of_frame(frames_.front())));
  }
  while (frames_.size() < most) {
    io::SceneFrame frame;
    if (Result<void> read = scene_->read_frame(frame); !read) return read;
    frames_.push_back(std::move(frame));
  }
  return {};
}

}  // namespace carom::cli
