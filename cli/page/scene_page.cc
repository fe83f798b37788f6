#include "cli/page/scene_page.h"

#include <span>

#include "cli/page/scene_view.h"
#include "cli/page_text.h"
#include "io/page.h"

namespace carom::cli {

Result<ScenePage> ScenePage::create(const std::string& path) {
  Result<io::AtomicFile> file = io::AtomicFile::create(path);
  if (!file) return file.error();
  return ScenePage(std::move(*file));
}

Result<void> ScenePage::add_frame(const World& world, const std::string& scene, uint64_t frame,
                                  const MotionTrack& track, double dt) {
  const std::string page = io::fill_page(kPagePieces, view_of(world, scene, frame, track, dt));
  return file_.write(std::as_bytes(std::span(page)));
}

}  // namespace carom::cli
