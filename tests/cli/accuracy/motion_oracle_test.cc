// The oracle of moving shapes against recorded sets of motions with known answers.
#include <cmath>
#include <limits>

#include "cli/scenes/shapes.h"
#include "io/files/npz.h"
#include "io/pairs_file.h"
#include "oracle/motion_oracle.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

using oracle::Fault;
using oracle::Meeting;

// The contents of NAME.reference.npz, one entry a pair.
struct KnownMotions {
  std::vector<double> low, high, least, scale, travel, closing;
  std::vector<uint8_t> state;

  enum State : uint8_t { never, impact, overlap, touch, graze };
};

template <class T>
std::vector<T> read_column(const io::NpzReader& reader, const char* name) {
  auto values = reader.read<T>(name, {io::kAny});
  EXPECT_TRUE(values) << values.error().message;
  return values ? *values : std::vector<T>();
}

KnownMotions read_known(const std::string& path) {
  auto reader = io::NpzReader::open(path);
  EXPECT_TRUE(reader) << reader.error().message;
  if (!reader) return {};
  const auto numbers = [&](const char* name) { return read_column<double>(*reader, name); };
  return {numbers("toi_lo"),
          numbers("toi_hi"),
          numbers("min_separation"),
          numbers("L"),
          numbers("travel"),
          numbers("closing"),
          read_column<uint8_t>(*reader, "state")};
}

struct MovingBody {
  Shape shape;
  Pose pose;
  Sweep sweep;
};

template <class Row>
auto vector_of(const std::vector<Row>& rows, size_t i) {
  using T = typename Row::value_type;
  return Eigen::Vector3<T>(rows[i][0], rows[i][1], rows[i][2]);
}

MovingBody body_of(const io::PairsFile& file, const io::PairSide& side, size_t i) {
  MovingBody body;
  auto shape = convert_simple_shape(file.shapes, side.shape[i]);
  EXPECT_TRUE(shape);
  if (shape) body.shape = *shape;
  body.pose.position = file.float64_positions ? vector_of(side.position64, i)
                                              : vector_of(side.position32, i).cast<double>();
  if (!side.orientation.empty()) {
    for (int c = 0; c < 4; ++c) body.pose.orientation.coeffs()[c] = side.orientation[i][c];
  }
  body.sweep.displacement = vector_of(side.displacement, i);
  if (!side.rotation.empty()) body.sweep.rotation = vector_of(side.rotation, i);
  return body;
}

void check_bracket(const KnownMotions& known, size_t i, const oracle::MovingPair<double>& pair) {
  const oracle::ImpactBracket<double> found = oracle::bracket_impact(pair);
  switch (known.state[i]) {
    case KnownMotions::never:
      EXPECT_EQ(found.meeting, Meeting::none) << known.least[i];
      break;
    case KnownMotions::impact:
      ASSERT_EQ(found.meeting, Meeting::found);
      EXPECT_LE(found.low, known.high[i]);
      EXPECT_GE(found.high, known.low[i]);
      if (known.least[i] < -1e-3 * known.scale[i]) {
        EXPECT_LE((found.high - found.low) * known.closing[i], 64 * pair.rounding());
      }
      break;
    case KnownMotions::overlap:
    case KnownMotions::touch:
      ASSERT_EQ(found.meeting, Meeting::found);
      EXPECT_EQ(found.low, 0);
      break;
    default:
      break;
  }
}

float rounded_down(double x) {
  const auto near = static_cast<float>(x);
  return near > x ? std::nextafter(near, -1.0f) : near;
}

// The oracle accepts the known time, and rejects one that is late or early by more than rounding.
void check_judge(const KnownMotions& known, size_t i, const MovingBody& a, const MovingBody& b) {
  const auto fault = [&](float toi) {
    return oracle::judge_impact(a.shape, a.pose, a.sweep, b.shape, b.pose, b.sweep, toi).fault;
  };
  const float never = std::numeric_limits<float>::infinity();
  if (known.state[i] == KnownMotions::never) {
    EXPECT_EQ(fault(never), Fault::none);
    EXPECT_EQ(fault(0.5f), Fault::early);
  }
  if (known.state[i] != KnownMotions::impact) return;
  const float toi = rounded_down(known.high[i]);
  const double speed = known.closing[i] / (known.scale[i] + known.travel[i]);
  EXPECT_EQ(fault(toi), Fault::none);
  if (speed > 1e-3 && toi > 1e-5f) {
    EXPECT_EQ(fault(toi - 1e-6f), Fault::early);
  }
  if (speed > 1e-3 && toi < 0.999f) {
    EXPECT_EQ(fault(toi + 1e-6f), Fault::late);
  }
  if (known.least[i] < -1e-9 * known.scale[i]) {
    EXPECT_EQ(fault(never), Fault::late);
  }
}

void check_set(const std::string& path) {
  const auto file = io::read_pairs(path);
  ASSERT_TRUE(file) << file.error().message;
  const KnownMotions known = read_known(path.substr(0, path.size() - 4) + ".reference.npz");
  ASSERT_EQ(known.state.size(), file->pairs);
  for (size_t i = 0; i < file->pairs && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(path + " pair " + std::to_string(i));
    const MovingBody a = body_of(*file, file->a, i), b = body_of(*file, file->b, i);
    check_bracket(known, i, {a.shape, a.pose, a.sweep, b.shape, b.pose, b.sweep});
    check_judge(known, i, a, b);
  }
}

TEST(MotionOracleTest, AgreesWithKnownMotions) {
  const std::string shared = shared_folder();
  if (shared.empty() || !std::filesystem::is_directory(shared + "/toi")) return;
  size_t sets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared + "/toi")) {
    const std::string path = entry.path().string();
    if (!path.ends_with(".npz") || path.ends_with(".reference.npz")) continue;
    ++sets;
    check_set(path);
  }
  EXPECT_GT(sets, 0u);
}

}  // namespace
}  // namespace carom::cli
