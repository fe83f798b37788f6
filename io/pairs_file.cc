#include "io/pairs_file.h"

#include <span>

namespace carom::io {
namespace {

template <class T>
Result<void> read_into(const NpzReader& reader, const std::string& name, uint64_t count,
                       bool optional, std::vector<T>& out) {
  if (optional && !reader.has(name)) return {};
  Result<std::vector<T>> values = reader.read<T>(name, {count});
  if (!values) return values.error();
  out = std::move(*values);
  return {};
}

Result<void> check_indices(const NpzReader& reader, const std::string& name,
                           const std::vector<uint32_t>& indices, size_t shapes) {
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < shapes) continue;
    return member_error(reader.path(), name,
                        "element " + std::to_string(i) + " is shape " + std::to_string(indices[i]) +
                            " (there are " + std::to_string(shapes) + ")");
  }
  return {};
}

Result<void> read_position(const NpzReader& reader, const std::string& name, uint64_t pairs,
                           PairSide& side) {
  const bool is_float64 = reader.has(name) && [&] {
    Result<NpyHeader> header = reader.header(name);
    return header && header->dtype == DType::kFloat64;
  }();
  if (is_float64) return read_into(reader, name, pairs, false, side.position64);
  return read_into(reader, name, pairs, false, side.position32);
}

Result<void> read_side(const NpzReader& reader, const std::string& letter, uint64_t pairs,
                       size_t shapes, PairSide& side) {
  Result<void> done = read_into(reader, "pair_shape_" + letter, pairs, false, side.shape);
  if (done) done = check_indices(reader, "pair_shape_" + letter, side.shape, shapes);
  if (done) done = read_position(reader, "position_" + letter, pairs, side);
  if (done) done = read_into(reader, "orientation_" + letter, pairs, true, side.orientation);
  if (done) done = read_into(reader, "displacement_" + letter, pairs, true, side.displacement);
  if (done) done = read_into(reader, "rotation_" + letter, pairs, true, side.rotation);
  return done;
}

void widen_positions(PairSide& side) {
  for (const std::array<float, 3>& p : side.position32) {
    side.position64.push_back({p[0], p[1], p[2]});
  }
  side.position32.clear();
}

Result<void> write_side(NpzWriter& writer, const std::string& letter, const PairSide& side,
                        bool float64_positions) {
  const auto add_optional = [&](const std::string& name, const auto& values) -> Result<void> {
    if (values.empty()) return {};
    return writer.add(name, values);
  };
  Result<void> done = writer.add("pair_shape_" + letter, side.shape);
  if (done) {
    done = float64_positions ? writer.add("position_" + letter, side.position64)
                             : writer.add("position_" + letter, side.position32);
  }
  if (done) done = add_optional("orientation_" + letter, side.orientation);
  if (done) done = add_optional("displacement_" + letter, side.displacement);
  if (done) done = add_optional("rotation_" + letter, side.rotation);
  return done;
}

// Adds a result array with one element for each pair, unless the caller left it empty. With zero
// pairs all arrays are empty, so all are written.
template <class T>
Result<void> add_result(NpzWriter& writer, const std::string& path, const std::string& name,
                        const std::vector<T>& values, uint64_t pairs) {
  if (values.empty() && pairs > 0) return {};
  if (values.size() != pairs) {
    return member_error(path, name,
                        "holds " + std::to_string(values.size()) + " elements (" +
                            std::to_string(pairs) + " were expected)");
  }
  return writer.add(name, values);
}

Result<void> add_manifold_points(NpzWriter& writer, const std::string& path,
                                 const PairResults& results) {
  const std::vector<std::array<float, 12>>& points = results.manifold_point;
  if (points.empty() && results.pairs > 0) return {};
  if (points.size() != results.pairs) {
    return member_error(path, "manifold_point",
                        "holds " + std::to_string(points.size()) + " elements (" +
                            std::to_string(results.pairs) + " were expected)");
  }
  const std::span<const float> values(reinterpret_cast<const float*>(points.data()),
                                      points.size() * 12);
  return writer.add("manifold_point", values, {results.pairs, 4, 3});
}

}  // namespace

Result<PairsFile> read_pairs(const std::string& path) {
  Result<NpzReader> reader = NpzReader::open(path);
  if (!reader) return reader.error();
  Result<void> done = check_version(*reader, false);
  if (!done) return done.error();
  Result<SceneShapes> shapes = read_shapes(*reader);
  if (!shapes) return shapes.error();

  PairsFile file;
  file.shapes = std::move(*shapes);
  const size_t shape_count = file.shapes.kind.size();
  Result<NpzStream> first = reader->stream("pair_shape_a", expected_of<uint32_t>({kAny}));
  if (!first) return first.error();
  file.pairs = first->header().shape[0];
  done = read_side(*reader, "a", file.pairs, shape_count, file.a);
  if (done) done = read_side(*reader, "b", file.pairs, shape_count, file.b);
  if (!done) return done.error();
  file.float64_positions = !file.a.position64.empty() || !file.b.position64.empty();
  if (file.float64_positions) {
    widen_positions(file.a);
    widen_positions(file.b);
  }
  return file;
}

Result<void> write_pairs(const std::string& path, const PairsFile& pairs) {
  Result<void> done = check_shapes(pairs.shapes, path);
  if (!done) return done;
  Result<NpzWriter> writer = NpzWriter::create(path);
  if (!writer) return writer.error();
  done = write_version(*writer);
  if (done) done = write_shapes(pairs.shapes, *writer);
  if (done) done = write_side(*writer, "a", pairs.a, pairs.float64_positions);
  if (done) done = write_side(*writer, "b", pairs.b, pairs.float64_positions);
  if (done) done = writer->finish();
  return done;
}

Result<void> write_pair_results(const std::string& path, const PairResults& results) {
  Result<NpzWriter> writer = NpzWriter::create(path);
  if (!writer) return writer.error();
  const uint64_t pairs = results.pairs;
  const auto add = [&](const char* name, const auto& values) {
    return add_result(*writer, path, name, values, pairs);
  };
  Result<void> done = add("overlap", results.overlap);
  if (done) done = add("separation", results.separation);
  if (done) done = add("normal", results.normal);
  if (done) done = add("point_a", results.point_a);
  if (done) done = add("point_b", results.point_b);
  if (done) done = add("manifold_count", results.manifold_count);
  if (done) done = add_manifold_points(*writer, path, results);
  if (done) done = add("manifold_separation", results.manifold_separation);
  if (done) done = add("toi", results.toi);
  if (done) done = add("status", results.status);
  if (done) done = add("sub_a", results.sub_a);
  if (done) done = add("sub_b", results.sub_b);
  if (done) done = writer->finish();
  return done;
}

}  // namespace carom::io
