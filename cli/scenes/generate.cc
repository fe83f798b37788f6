// carom generate: writes a generated scene.
#include <memory>

#include "cli/commands.h"
#include "cli/scenes/scene_bounds.h"
#include "cli/support/command_line.h"
#include "cli/support/progress.h"
#include "io/generate/generator.h"
#include "io/recording.h"
#include "io/scene.h"

namespace carom::cli {
namespace {

struct GenerateOptions {
  std::string spec;
  std::string output;
};

Result<void> write_scene(io::SceneReader& scene, const std::string& path, Progress& progress) {
  Result<io::SceneWriter> writer = io::SceneWriter::create(path, scene.info());
  if (!writer) return writer.error();
  io::SceneFrame frame;
  for (uint64_t i = 0; i < scene.info().frames; ++i) {
    progress.update(i);
    if (Result<void> read = scene.read_frame(frame); !read) return read.error();
    if (Result<void> written = writer->write_frame(frame); !written) return written.error();
  }
  return writer->finish();
}

const char* object_type(const io::SceneInfo& info) {
  switch (static_cast<ShapeKind>(info.shapes.kind.front())) {
    case ShapeKind::sphere:
      return "Spheres";
    case ShapeKind::capsule:
      return "Capsules";
    case ShapeKind::box:
      return "Boxes";
    case ShapeKind::hull:
      return "Hulls";
    case ShapeKind::mesh:
      return "Meshes";
    case ShapeKind::compound:
      return "Compounds";
    case ShapeKind::cylinder:
      return "Cylinders";
    case ShapeKind::cone:
      return "Cones";
    case ShapeKind::ellipsoid:
      return "Ellipsoids";
    default:
      return "Cubes";
  }
}

Result<void> write_recording(io::SceneReader& scene, const std::string& path, Progress& progress) {
  const io::SceneInfo& info = scene.info();
  Result<io::RecordingWriter> writer =
      io::RecordingWriter::create(path, info.name, object_type(info), info.bodies);
  if (!writer) return writer.error();
  SceneBounds bounds(info);
  io::SceneFrame frame;
  for (uint64_t i = 0; i < info.frames; ++i) {
    progress.update(i);
    if (Result<void> read = scene.read_frame(frame); !read) return read.error();
    if (Result<void> written = writer->write_frame(bounds.boxes(frame)); !written) {
      return written.error();
    }
  }
  return writer->finish();
}

Result<int> generate(const GenerateOptions& options, const Console& console) {
  Result<io::GeneratorSpec> spec = io::parse_generator(options.spec);
  if (!spec) return spec.error();
  std::unique_ptr<io::SceneReader> scene = io::open_generator(*spec);
  Progress progress(console, "frame", scene->info().frames);
  bool recording =
      io::has_extension(options.output, ".aabb") || io::has_extension(options.output, ".aabbs");
  if (recording && (spec->mixed || spec->kind == io::GeneratorKind::bullets)) {
    return Error{options.output + ": bodies of several kinds: only a scene (.npz) holds them"};
  }
  Result<void> written = recording ? write_recording(*scene, options.output, progress)
                                   : write_scene(*scene, options.output, progress);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_generate_command(CommandLine& program) {
  auto options = std::make_shared<GenerateOptions>();
  Command command = program.add_command("generate", "Write a generated scene");
  command.add_option("KIND", options->spec, "KIND[:key=value,...]").required();
  command
      .add_option("-o,--output", options->output,
                  "The file: a scene (.npz), or a recording of bounds if its name ends in .aabb or "
                  ".aabbs")
      .required();
  command.footer(io::kGeneratorHelp);
  command.run([options](const Console& console) { return generate(*options, console); });
}

}  // namespace carom::cli
