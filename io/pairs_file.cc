#include "io/pairs_file.h"

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>

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

template <class T>
Result<void> add_column(NpzWriter& writer, const std::string& name, const T* column,
                        uint64_t pairs) {
  return writer.add(name, std::span(column, pairs), {pairs});
}

Result<void> add_column(NpzWriter& writer, const std::string& name,
                        const std::array<float*, 3>& columns, uint64_t pairs) {
  std::vector<std::array<float, 3>> rows(pairs);
  for (size_t i = 0; i < pairs; ++i) rows[i] = {columns[0][i], columns[1][i], columns[2][i]};
  return writer.add(name, rows);
}

// A manifold is two arrays in the file.
Result<void> add_manifolds(NpzWriter& writer, const ResultColumns& columns, uint64_t pairs) {
  std::vector<float> points(12 * pairs, std::numeric_limits<float>::quiet_NaN());
  std::vector<float> separations(4 * pairs, std::numeric_limits<float>::quiet_NaN());
  for (size_t pair = 0; pair < pairs; ++pair) {
    for (size_t k = 0; k < columns.manifold_count[pair]; ++k) {
      const std::array<float, 3>& point = columns.manifold[pair].point[k];
      std::copy(point.begin(), point.end(), &points[12 * pair + 3 * k]);
      separations[4 * pair + k] = columns.manifold[pair].separation[k];
    }
  }
  Result<void> done = writer.add("manifold_point", std::span<const float>(points), {pairs, 4, 3});
  if (!done) return done;
  return writer.add("manifold_separation", std::span<const float>(separations), {pairs, 4});
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

Result<void> write_pair_results(const std::string& path, uint64_t pairs,
                                const ResultColumns& columns, const float* toi,
                                const RegionArrays* regions) {
  Result<NpzWriter> writer = NpzWriter::create(path);
  if (!writer) return writer.error();
  Result<void> done;
  const auto add = [&](const ColumnInfo& info, const auto& column) {
    using Column = std::remove_cvref_t<decltype(column)>;
    const bool is_member = info.role != ColumnRole::bound && info.role != ColumnRole::memory &&
                           info.role != ColumnRole::name;
    const bool is_there = column != Column{} || (pairs == 0 && is_member);
    if (!done || !is_there) return;
    if constexpr (std::is_same_v<Column, PointNames*>) {
      return;  // no file holds them
    } else if constexpr (std::is_same_v<Column, ManifoldPoints*>) {
      done = add_manifolds(*writer, columns, pairs);
    } else {
      done = add_column(*writer, info.name, column, pairs);
    }
  };
  for_each_result(add, columns);
  if (done && (toi || pairs == 0)) done = add_column(*writer, "toi", toi, pairs);
  if (done && (regions || pairs == 0)) {
    done = write_regions(*writer, regions ? *regions : RegionArrays());
  }
  if (done) done = writer->finish();
  return done;
}

}  // namespace carom::io
