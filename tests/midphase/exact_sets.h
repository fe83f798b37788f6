// Random pairs with meshes and compounds whose exact answer is known: half of them nearly touch.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "oracle/convex_random.h"
#include "tests/support/composite_oracle.h"
#include "tests/support/composites.h"

namespace carom::test {

struct ExactPair {
  TestPair pair;
  CompositeOracle oracle;
  ExactSeparations exact;

  explicit ExactPair(const TestPair& of) : ExactPair(of, CompositeOracle(of)) {}
  ExactPair(const TestPair& of, CompositeOracle oracle_of)
      : pair(of), oracle(std::move(oracle_of)), exact(oracle.separations()) {}
};

class ExactSets {
 public:
  explicit ExactSets(uint64_t seed)
      : random_(seed), shapes_({}, random_), slender_({.aspect = 1e3}, random_) {}

  // A pair in random order, of size 1e-3, 1 or 1e4, up to a million sizes from the origin.
  ExactPair next(ShapeKind kind_a, ShapeKind kind_b);

 private:
  // A quarter is placed anywhere. The others are moved along the normal to a given separation or
  // depth: some up to a third of the size, most a ten-thousandth of it or less.
  // Returns the oracle of the placed pair.
  CompositeOracle place(TestPair& pair, double size);

  Shape shape(ShapeKind kind, double size, bool is_large);

  // A terrain or a closed surface, 18 to 176 triangles, two-sided, some thick.
  Mesh mesh(double size, int most);

  Mesh terrain(double size, int n, const MeshRules& rules);

  // Two poles and n - 1 rings of n + 2 corners each; round, or with bumps.
  Mesh globe(double size, int n, const MeshRules& rules);

  // Triangles that share no corners: none has an inner edge.
  static Mesh shattered(const Mesh& mesh);

  Compound compound(double size);

  Shape child_shape(double size);

  oracle::Random random_;
  oracle::ConvexRandom shapes_;
  oracle::ConvexRandom slender_;
};

}  // namespace carom::test
