// carom check: reads shapes and says what is wrong with them.
#include <memory>
#include <utility>
#include <vector>

#include "carom/reference/reference.h"
#include "cli/check/check_report.h"
#include "cli/commands.h"
#include "cli/scenes/shapes.h"
#include "cli/support/command_line.h"
#include "cli/support/json_output.h"
#include "cli/support/options.h"
#include "cli/support/progress.h"
#include "io/files/npz.h"
#include "io/models/mesh_file.h"
#include "io/models/read_model.h"

namespace carom::cli {
namespace {

struct CheckOptions {
  std::string input;
  std::string json;
};

Eigen::Vector3f scale_of(const io::SceneShapes& shapes, size_t index) {
  if (shapes.scale.empty()) return Eigen::Vector3f::Ones();
  return Eigen::Map<const Eigen::Vector3f>(shapes.scale[index].data());
}

bool mirrors(const io::SceneShapes& shapes, size_t index) {
  return (scale_of(shapes, index).array() < 0).count() % 2 != 0;
}

void add_vertices(const io::SceneShapes& shapes, ShapeReport& report) {
  const auto [first, count] = shapes.vertex_range[report.index];
  const Eigen::Vector3f scale = scale_of(shapes, report.index);
  for (size_t i = first; i < size_t{first} + count; ++i) {
    const Eigen::Map<const Eigen::Vector3f> vertex(shapes.vertices[i].data());
    report.vertices.push_back(vertex.cwiseProduct(scale));
  }
}

void check_hull(ShapeReport& report) {
  Result<BuiltHull> hull = build_hull(report.vertices);
  if (hull) report.hull = std::move(*hull);
}

void check_triangles(ShapeReport& report) {
  report.mesh = check_mesh(report.vertices, report.triangles);
}

void check_compound(const io::SceneShapes& shapes, ShapeReport& report) {
  const auto [first, count] = shapes.child_range[report.index];
  report.children = count;
  if (count == 0) report.problem = "it has no children";
  for (size_t i = first; i < size_t{first} + count; ++i) {
    if (shapes.kind[shapes.child_shape[i]] == static_cast<uint8_t>(ShapeKind::halfspace)) {
      report.problem = "child " + std::to_string(i - first) + " is a halfspace";
    }
  }
  const bool is_scaled = scale_of(shapes, report.index) != Eigen::Vector3f::Ones();
  if (!report.problem.empty() || !is_scaled) return;
  const Result<Shape> shape = convert_shape(shapes, report.index);
  if (!shape) report.problem = "it is " + shape.error().message;
}

// Why a shape (not a compound) is invalid; empty if it is valid.
std::string problem_of(const io::SceneShapes& shapes, size_t index) {
  const Result<Shape> shape = convert_simple_shape(shapes, index);
  if (!shape) return "it is " + shape.error().message;
  if (reference::is_valid(*shape, Pose(), PositionType::float32)) return "";
  return "a number is not finite, or a size is negative";
}

ShapeReport report_of(const io::SceneShapes& shapes, size_t index) {
  ShapeReport report;
  report.index = index;
  report.kind = static_cast<ShapeKind>(shapes.kind[index]);
  if (report.kind == ShapeKind::compound) {
    check_compound(shapes, report);
    return report;
  }
  report.problem = problem_of(shapes, index);
  if (report.kind == ShapeKind::hull) {
    add_vertices(shapes, report);
    check_hull(report);
  } else if (report.kind == ShapeKind::mesh) {
    add_vertices(shapes, report);
    const auto [first, count] = shapes.triangle_range[index];
    const auto begin = shapes.triangles.begin() + first;
    report.triangles.assign(begin, begin + count);
    if (mirrors(shapes, index)) {
      for (auto& [a, b, c] : report.triangles) std::swap(b, c);
    }
    check_triangles(report);
  }
  return report;
}

ShapeReport report_of(io::MeshPart part, size_t index) {
  ShapeReport report;
  report.index = index;
  report.name = std::move(part.name);
  report.vertices = std::move(part.vertices);
  report.triangles = std::move(part.triangles);
  check_triangles(report);
  if (report.mesh->not_finite.count > 0) report.problem = "a vertex is not finite";
  return report;
}

Result<void> check_mesh_file(const std::string& path, ReportSink& sink, const Console& console) {
  Result<std::vector<io::MeshPart>> parts = io::read_mesh_file(path);
  if (!parts) return parts.error();
  Progress progress(console, "mesh", parts->size());
  for (size_t i = 0; i < parts->size(); ++i) {
    progress.update(i);
    sink.add(report_of(std::move((*parts)[i]), i));
  }
  return {};
}

Result<void> check_model(const std::string& path, ReportSink& sink, const Console& console) {
  Result<io::Model> model = io::read_model(path);
  if (!model) return model.error();
  const io::SceneShapes& shapes = model->info.shapes;
  Progress progress(console, "shape", shapes.kind.size());
  for (size_t i = 0; i < shapes.kind.size(); ++i) {
    progress.update(i);
    ShapeReport report = report_of(shapes, i);
    report.name = model->shape_names[i];
    sink.add(report);
  }
  return {};
}

Result<void> check_archive(const std::string& path, ReportSink& sink, const Console& console) {
  Result<io::NpzReader> reader = io::NpzReader::open(path);
  if (!reader) return reader.error();
  Result<io::SceneShapes> shapes = io::read_shapes(*reader);
  if (!shapes) return shapes.error();
  Progress progress(console, "shape", shapes->kind.size());
  for (size_t i = 0; i < shapes->kind.size(); ++i) {
    progress.update(i);
    sink.add(report_of(*shapes, i));
  }
  return {};
}

Result<int> check(const CheckOptions& options, const Console& console) {
  Result<JsonOutput> json = JsonOutput::open(options.json);
  if (!json) return json.error();
  ReportSink sink(*json, console);
  const auto check_file = io::names_mesh(options.input)    ? check_mesh_file
                          : io::names_model(options.input) ? check_model
                                                           : check_archive;
  const Result<void> done = check_file(options.input, sink, console);
  if (!done) return done.error();
  const Result<void> written = sink.finish(options.input);
  return written ? Result<int>(0) : written.error();
}

}  // namespace

void add_check_command(CommandLine& program) {
  auto options = std::make_shared<CheckOptions>();
  Command command =
      program.add_command("check", "Say what is wrong with shapes: convex, watertight, ...");
  command
      .add_option("FILE", options->input,
                  "A mesh (.obj, .stl, .gltf, .glb, .dae), a model (.urdf, .xml), a scene or pairs "
                  "(.npz)")
      .required();
  add_json_option(command, options->json);
  command.run([options](const Console& console) { return check(*options, console); });
}

}  // namespace carom::cli
