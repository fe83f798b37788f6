#include "cli/check/check_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "io/printable.h"

namespace carom::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string counted(uint64_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

// Prints one report as text: rows of a name and a value.
class Printer {
 public:
  Printer(const ShapeReport& report, std::ostream& out) : report_(report), out_(out) {}

  void print() {
    out_ << "shape " << report_.index << ": " << name(report_.kind);
    if (!report_.name.empty()) out_ << " '" << io::printable(report_.name) << "'";
    out_ << '\n';
    if (!report_.problem.empty()) row("valid", "no: " + report_.problem);
    if (report_.kind == ShapeKind::compound) row("children", std::to_string(report_.children));
    if (report_.hull) print_hull(*report_.hull);
    if (report_.mesh) print_mesh(*report_.mesh);
  }

 private:
  void row(const std::string& key, const std::string& text) {
    constexpr size_t kWidth = 12;
    out_ << "  " << key << std::string(key.size() < kWidth ? kWidth - key.size() : 1, ' ') << text
         << '\n';
  }

  std::string at(uint32_t vertex) const {
    const Eigen::Vector3f& p = report_.vertices[vertex];
    return "(" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + ")";
  }
  std::string vertex_text(uint32_t vertex) const {
    return "vertex " + std::to_string(vertex) + " at " + at(vertex);
  }
  std::string triangle_text(uint32_t triangle) const {
    const auto [a, b, c] = report_.triangles[triangle];
    return "triangle " + std::to_string(triangle) + " (" + std::to_string(a) + ", " +
           std::to_string(b) + ", " + std::to_string(c) + ") at " + at(a) + ' ' + at(b) + ' ' +
           at(c);
  }
  std::string edge_text(const MeshEdge& edge) const {
    return "edge " + std::to_string(edge.from) + "-" + std::to_string(edge.to) + " from " +
           at(edge.from) + " to " + at(edge.to) + " of triangle " + std::to_string(edge.triangle);
  }

  template <class T, class Text>
  void print_findings(const std::string& what, const Findings<T>& findings, const Text& text) {
    if (findings.count == 0) return;
    row(what, std::to_string(findings.count));
    for (const T& finding : findings.first) out_ << "    " << text(finding) << '\n';
    const uint64_t more = findings.count - findings.first.size();
    if (more > 0) out_ << "    and " << more << " more\n";
  }

  void print_hull(const BuiltHull& hull) {
    row("vertices", std::to_string(report_.vertices.size()) + ": " +
                        counted(hull.geometry->points().size(), "corner", "corners") + ", " +
                        counted(hull.duplicates, "duplicate", "duplicates") + ", " +
                        std::to_string(hull.inside) + " inside");
    row("form", std::string(name(hull.form)) + ", " +
                    counted(hull.geometry->faces().size(), "face", "faces"));
    row("convex", "yes");
  }

  void print_mesh(const MeshReport& mesh) {
    row("mesh", counted(mesh.triangles, "triangle", "triangles") + ", " +
                    counted(mesh.vertices, "vertex", "vertices"));
    row("watertight", mesh.is_watertight() ? "yes" : "no");
    row("convex", mesh.is_convex() ? "yes" : "no" + dent_text(mesh));
    if (mesh.inside_out) row("inside out", "the fronts of the triangles look inwards");
    if (mesh.unused_vertices > 0)
      row("unused", counted(mesh.unused_vertices, "vertex", "vertices"));
    const auto triangle = [&](uint32_t t) { return triangle_text(t); };
    const auto edge = [&](const MeshEdge& e) { return edge_text(e); };
    print_findings("vertices that are not finite", mesh.not_finite,
                   [&](uint32_t v) { return vertex_text(v); });
    print_findings("triangles with a corner twice", mesh.repeated_index, triangle);
    print_findings("triangles without area", mesh.without_area, triangle);
    print_findings("edges of one triangle", mesh.open_edges, edge);
    print_findings("edges of more than two triangles", mesh.crowded_edges, [&](const MeshEdge& e) {
      return edge_text(e) + " and " + std::to_string(e.triangles - 1) + " others";
    });
    print_findings("edges of triangles that look to different sides", mesh.opposed_edges, edge);
    print_findings("duplicate vertices", mesh.duplicate_vertices,
                   [&](const std::array<uint32_t, 2>& pair) {
                     return vertex_text(pair[0]) + " is vertex " + std::to_string(pair[1]);
                   });
  }

  std::string dent_text(const MeshReport& mesh) const {
    if (!mesh.dent) return "";
    const Dent& dent = *mesh.dent;
    const std::string how = vertex_text(dent.vertex) + " is " + number(dent.height) +
                            " in front of triangle " + std::to_string(dent.triangle);
    return ": " + (dent.at_edge ? edge_text(dent.edge) + " is bent inwards; " + how : how);
  }

  const ShapeReport& report_;
  std::ostream& out_;
};

class JsonReport {
 public:
  explicit JsonReport(const ShapeReport& report) : report_(report) {}

  Json json() const {
    Json json;
    json["shape"] = report_.index;
    if (!report_.name.empty()) json["name"] = report_.name;
    json["kind"] = name(report_.kind);
    json["valid"] = report_.problem.empty();
    if (!report_.problem.empty()) json["problem"] = report_.problem;
    if (report_.kind == ShapeKind::compound) json["children"] = report_.children;
    if (report_.hull) add_hull(*report_.hull, json);
    if (report_.mesh) add_mesh(*report_.mesh, json);
    return json;
  }

 private:
  Json at(uint32_t vertex) const {
    const Eigen::Vector3f& p = report_.vertices[vertex];
    return {p.x(), p.y(), p.z()};
  }

  Json of_vertex(uint32_t vertex) const { return {{"vertex", vertex}, {"at", at(vertex)}}; }

  Json of_triangle(uint32_t triangle) const {
    const auto [a, b, c] = report_.triangles[triangle];
    return {{"triangle", triangle}, {"vertices", {a, b, c}}, {"at", {at(a), at(b), at(c)}}};
  }

  Json of_edge(const MeshEdge& edge) const {
    return {{"vertices", {edge.from, edge.to}},
            {"at", {at(edge.from), at(edge.to)}},
            {"triangle", edge.triangle},
            {"triangles", edge.triangles}};
  }

  Json of_duplicate(const std::array<uint32_t, 2>& pair) const {
    return {{"vertex", pair[0]}, {"same_as", pair[1]}, {"at", at(pair[0])}};
  }

  template <class T, class Argument>
  Json list(const Findings<T>& findings, Json (JsonReport::*one)(Argument) const) const {
    Json first = Json::array();
    for (const T& finding : findings.first) first.push_back((this->*one)(finding));
    return {{"count", findings.count}, {"first", first}};
  }

  void add_hull(const BuiltHull& hull, Json& json) const {
    json["vertices"] = report_.vertices.size();
    json["form"] = name(hull.form);
    json["corners"] = hull.geometry->points().size();
    json["faces"] = hull.geometry->faces().size();
    json["duplicates"] = hull.duplicates;
    json["inside"] = hull.inside;
    json["convex"] = true;
  }

  void add_mesh(const MeshReport& mesh, Json& json) const {
    json["vertices"] = mesh.vertices;
    json["triangles"] = mesh.triangles;
    json["watertight"] = mesh.is_watertight();
    json["convex"] = mesh.is_convex();
    if (mesh.dent) json["dent"] = dent(*mesh.dent);
    json["inside_out"] = mesh.inside_out;
    json["unused_vertices"] = mesh.unused_vertices;
    json["vertices_not_finite"] = list(mesh.not_finite, &JsonReport::of_vertex);
    json["duplicate_vertices"] = list(mesh.duplicate_vertices, &JsonReport::of_duplicate);
    json["repeated_index"] = list(mesh.repeated_index, &JsonReport::of_triangle);
    json["without_area"] = list(mesh.without_area, &JsonReport::of_triangle);
    json["open_edges"] = list(mesh.open_edges, &JsonReport::of_edge);
    json["crowded_edges"] = list(mesh.crowded_edges, &JsonReport::of_edge);
    json["opposed_edges"] = list(mesh.opposed_edges, &JsonReport::of_edge);
  }

  Json dent(const Dent& dent) const {
    Json json = {{"height", dent.height},
                 {"triangle", dent.triangle},
                 {"vertex", dent.vertex},
                 {"at", at(dent.vertex)}};
    if (dent.at_edge) json["edge"] = of_edge(dent.edge);
    return json;
  }

  const ShapeReport& report_;
};

}  // namespace

ReportSink::ReportSink(JsonOutput& output, const Console& console)
    : output_(output), console_(console) {
  if (output.wanted()) shapes_ = std::make_unique<Json>(Json::array());
}

ReportSink::~ReportSink() = default;

void ReportSink::add(const ShapeReport& report) {
  if (shapes_) {
    shapes_->push_back(JsonReport(report).json());
  } else {
    Printer(report, console_.out).print();
  }
}

Result<void> ReportSink::finish(const std::string& file) {
  if (!shapes_) return {};
  return output_.write({{"file", file}, {"shapes", std::move(*shapes_)}}, console_);
}

}  // namespace carom::cli
