#include "io/generate/spec.h"

#include <charconv>
#include <cstdio>
#include <set>
#include <string_view>

#include "io/printable.h"
#include "io/shape_arrays.h"

namespace carom::io {
namespace {

constexpr uint64_t kMaxBodies = 100'000'000;
constexpr uint64_t kMaxFrames = 1'000'000'000;
constexpr char kTurningShapes[] =
    "box, capsule, hull, mesh, compound, cylinder, cone, ellipsoid, mixed";

Error spec_error(const GeneratorSpec& spec, const std::string& text) {
  return {"generator " + quoted_name(spec.text) + ": " + text};
}

std::optional<GeneratorKind> kind_from_name(std::string_view name) {
  if (name == "brownian") return GeneratorKind::brownian;
  if (name == "varied") return GeneratorKind::varied;
  if (name == "static") return GeneratorKind::level;
  if (name == "still") return GeneratorKind::still;
  if (name == "bullets") return GeneratorKind::bullets;
  return std::nullopt;
}

std::optional<ShapeKind> shape_from_name(std::string_view name) {
  if (name == "cube") return ShapeKind::aabb;
  if (name == "sphere") return ShapeKind::sphere;
  if (name == "box") return ShapeKind::box;
  if (name == "capsule") return ShapeKind::capsule;
  if (name == "hull") return ShapeKind::hull;
  if (name == "mesh") return ShapeKind::mesh;
  if (name == "compound") return ShapeKind::compound;
  if (name == "cylinder") return ShapeKind::cylinder;
  if (name == "cone") return ShapeKind::cone;
  if (name == "ellipsoid") return ShapeKind::ellipsoid;
  return std::nullopt;
}

const char* keys_of(GeneratorKind kind) {
  switch (kind) {
    case GeneratorKind::level:
      return "n, frames, seed, density, speed, dt, shape, rounding, spin, positions, motion";
    case GeneratorKind::still:
      return "n, frames, seed, density, dt, shape, rounding, positions";
    case GeneratorKind::bullets:
      return "n, frames, seed, speed, dt, spin, positions";
    default:
      return "n, frames, seed, density, speed, dt, shape, rounding, spin, positions";
  }
}

template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Parses one key=value at a time.
class SpecParser {
 public:
  explicit SpecParser(GeneratorSpec& spec) : spec_(spec) {}

  Result<void> assign(std::string_view item) {
    size_t equals = item.find('=');
    if (equals == std::string_view::npos) {
      return spec_error(spec_, quoted_name(item) + " is not key=value");
    }
    key_ = item.substr(0, equals);
    value_ = item.substr(equals + 1);
    if (!seen_.insert(std::string(key_)).second) return spec_error(spec_, quoted() + " again");
    return assign_key();
  }

  // Checks conditions on more than one key.
  Result<void> check() const {
    const bool is_rounded = spec_.mixed || takes_rounding(static_cast<uint8_t>(spec_.shape));
    if (spec_.rounding > 0 && !is_rounded) {
      return spec_error(
          spec_,
          "'rounding' needs a shape that has one (box, hull, cylinder, cone, ellipsoid, "
          "mixed)");
    }
    if (!spec_.spin || spec_.has_orientation()) return {};
    return spec_error(spec_,
                      std::string("'spin' needs a shape that turns (") + kTurningShapes + ")");
  }

 private:
  Result<void> assign_key() {
    bool moves = spec_.kind != GeneratorKind::still;
    bool mixed = spec_.kind == GeneratorKind::bullets;
    if (key_ == "n") return integer(1, kMaxBodies, spec_.bodies);
    if (key_ == "frames") return integer(1, kMaxFrames, spec_.frames);
    if (key_ == "seed") return integer(0, UINT64_MAX, spec_.seed);
    if (key_ == "density" && !mixed) return real(1e-9, 1e3, spec_.density.emplace());
    if (key_ == "speed" && moves) return real(0, 1e9, spec_.speed.emplace());
    if (key_ == "dt") return real(1e-9, 1e6, spec_.dt);
    if (key_ == "shape" && !mixed) return shape();
    if (key_ == "rounding" && !mixed) return real(0, 1e9, spec_.rounding);
    if (key_ == "spin" && moves) return real(0, 1e6, spec_.spin.emplace());
    if (key_ == "positions") return choice("float32", "float64", spec_.float64_positions);
    if (key_ == "motion" && spec_.kind == GeneratorKind::level) {
      return choice("dynamic", "static", spec_.mark_static);
    }
    return spec_error(spec_,
                      "unknown key " + quoted_name(key_) + " (keys: " + keys_of(spec_.kind) + ")");
  }

  Result<void> integer(uint64_t lower, uint64_t upper, uint64_t& out) {
    std::optional<uint64_t> value = parse_number<uint64_t>(value_);
    if (!value || *value < lower || *value > upper) {
      return spec_error(spec_, quoted() + " is not a whole number from " + std::to_string(lower) +
                                   " to " + std::to_string(upper));
    }
    out = *value;
    return {};
  }

  Result<void> real(double lower, double upper, double& out) {
    std::optional<double> value = parse_number<double>(value_);
    if (!value || !(*value >= lower && *value <= upper)) {
      char range[80];
      std::snprintf(range, sizeof range, " is not a number from %g to %g", lower, upper);
      return spec_error(spec_, quoted() + range);
    }
    out = *value;
    return {};
  }

  Result<void> shape() {
    spec_.mixed = value_ == "mixed";
    if (spec_.mixed) return {};
    std::optional<ShapeKind> kind = shape_from_name(value_);
    if (!kind) {
      return spec_error(spec_, quoted() + " is none of cube, sphere, " + kTurningShapes);
    }
    spec_.shape = *kind;
    return {};
  }

  Result<void> choice(std::string_view no, std::string_view yes, bool& out) {
    if (value_ != no && value_ != yes) {
      return spec_error(spec_,
                        quoted() + " is neither " + std::string(no) + " nor " + std::string(yes));
    }
    out = value_ == yes;
    return {};
  }

  std::string quoted() const { return quoted_name(std::string(key_) + "=" + std::string(value_)); }

  GeneratorSpec& spec_;
  std::set<std::string> seen_;
  std::string_view key_;
  std::string_view value_;
};

}  // namespace

const char kGeneratorKinds[] = "brownian, varied, static, still, bullets";

const char kGeneratorHelp[] =
    "KIND[:key=value,...]\n"
    "  brownian  unit cubes at random places, every one on its way, 1 % of them given a new\n"
    "            velocity every frame\n"
    "  varied    the same with edges from 1 to 316, log-uniform\n"
    "  static    boxes of 0.5 to 4 in clusters on rolling ground, of which nine in ten never move\n"
    "  still     brownian without motion\n"
    "  bullets   spheres, capsules, boxes and hulls of 2 to 10 cm that fly and turn in a room of\n"
    "            20 m, its walls and 12 sheets one-sided meshes, with 24 boxes of 2 cm\n"
    "  n=10000           bodies; bullets: those that fly, 200\n"
    "  frames=60         frames before the first one comes again; bullets 30\n"
    "  seed=1\n"
    "  density=0.1       sum of volumes / world volume; static: bodies a square metre, 1/6\n"
    "  speed=S           the greatest, metres a second: brownian 0.75 world sides, varied 5 / dt,\n"
    "                    static 6, bullets 300, and the least is a sixth of it\n"
    "  dt=0.0333...      seconds between frames; bullets 1/60\n"
    "  shape=cube        bounds of cubes that keep a random orientation; or sphere; or\n"
    "                    box, capsule, hull, mesh, compound, cylinder, cone or ellipsoid, which\n"
    "                    start in random orientations and turn as they move; or mixed: sphere and\n"
    "                    these in turn\n"
    "  rounding=0        metres around boxes, hulls, cylinders, cones and ellipsoids\n"
    "  spin=1            of what turns: the greatest, radians a second; with speed=0: 0; bullets\n"
    "                    200\n"
    "  positions=float32 or float64\n"
    "  motion=dynamic    static only: motion=static marks what never moves as static\n";

bool is_generator_text(const std::string& text) {
  std::string_view word = std::string_view(text).substr(0, text.find(':'));
  if (word.empty()) return false;
  for (char c : word) {
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
    if (!letter) return false;
  }
  return true;
}

Result<GeneratorSpec> parse_generator(const std::string& text) {
  GeneratorSpec spec;
  spec.text = text;
  std::string_view rest = text;
  std::string_view name = rest.substr(0, rest.find(':'));
  std::optional<GeneratorKind> kind = kind_from_name(name);
  if (!kind) {
    return Error{"unknown generator " + quoted_name(name) + " (generators: " + kGeneratorKinds +
                 ")"};
  }
  spec.kind = *kind;
  if (spec.kind == GeneratorKind::bullets) {
    spec.bodies = 200;
    spec.frames = 30;
    spec.dt = 1.0 / 60.0;
  }
  if (name.size() == rest.size()) return spec;

  SpecParser parser(spec);
  rest.remove_prefix(name.size() + 1);
  for (;;) {
    size_t comma = rest.find(',');
    Result<void> done = parser.assign(rest.substr(0, comma));
    if (!done) return done.error();
    if (comma == std::string_view::npos) break;
    rest.remove_prefix(comma + 1);
  }
  Result<void> valid = parser.check();
  return valid ? Result<GeneratorSpec>(spec) : valid.error();
}

}  // namespace carom::io
