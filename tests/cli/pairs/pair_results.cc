#include "tests/cli/pairs/pair_results.h"

namespace carom::cli {

PairResultsFile read_pair_results(const std::string& path, size_t pairs) {
  auto reader = io::NpzReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  PairResultsFile results;
  const auto read = [&](const char* name, auto& out, const io::Shape& shape) {
    using T = typename std::decay_t<decltype(out)>::value_type;
    if (!reader->has(name)) return;
    auto values = reader->read<T>(name, shape);
    EXPECT_TRUE(values) << values.error().message;
    if (values) out = *values;
  };
  read("overlap", results.overlap, {pairs});
  read("status", results.status, {pairs});
  read("separation", results.separation, {pairs});
  read("normal", results.normal, {pairs});
  read("point_a", results.point_a, {pairs});
  read("point_b", results.point_b, {pairs});
  read("manifold_count", results.manifold_count, {pairs});
  read("manifold_point", results.manifold_point, {pairs, 4, 3});
  read("manifold_separation", results.manifold_separation, {pairs});
  read("toi", results.toi, {pairs});
  read("sub_a", results.sub_a, {pairs});
  read("sub_b", results.sub_b, {pairs});
  return results;
}

}  // namespace carom::cli
