#include "cli/scenes/scene_source.h"

#include <filesystem>
#include <system_error>

#include "io/generate/generator.h"

namespace carom::cli {

bool names_generator(const std::string& text) {
  std::error_code error;
  return io::is_generator_text(text) && !std::filesystem::exists(text, error);
}

Result<std::unique_ptr<io::SceneReader>> open_source(const std::string& text) {
  if (!names_generator(text)) return io::open_scene(text);
  Result<io::GeneratorSpec> spec = io::parse_generator(text);
  if (!spec) return spec.error();
  return io::open_generator(*spec);
}

}  // namespace carom::cli
