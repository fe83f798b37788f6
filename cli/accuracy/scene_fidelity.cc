#include "cli/accuracy/scene_fidelity.h"

#include <memory>

#include "cli/scenes/loaded_scene.h"

namespace carom::cli {
namespace {

constexpr size_t kMostFrames = 60;
constexpr int kShortRounds = 2;
constexpr int kLongRounds = 5;

}  // namespace

Result<accuracy::FidelityReport> measure_scene_fidelity(
    const std::vector<std::string>& more, bool is_short,
    const std::function<void(size_t, size_t)>& before_scene) {
  std::vector<std::string> sources = accuracy::fidelity_scenes(is_short);
  sources.insert(sources.end(), more.begin(), more.end());
  accuracy::FidelityReport report;
  for (size_t i = 0; i < sources.size(); ++i) {
    before_scene(i, sources.size());
    Result<std::unique_ptr<LoadedScene>> scene = LoadedScene::open(sources[i]);
    if (!scene) return scene.error();
    if (Result<void> read = (*scene)->load(kMostFrames); !read) return read.error();
    const int rounds = is_short ? kShortRounds : kLongRounds;
    if (Result<void> measured = measure_fidelity(**scene, rounds, report); !measured) {
      return measured.error();
    }
  }
  return report;
}

}  // namespace carom::cli
