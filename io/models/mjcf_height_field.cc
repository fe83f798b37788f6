#include "io/models/mjcf_height_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "io/files/file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

// Samples row by row, from the least y; x is the fast index.
struct Samples {
  uint64_t columns = 0, rows = 0;
  std::vector<float> values;
};

constexpr uint64_t kMostSamples = uint64_t{1} << 28;

bool are_in_range(uint64_t columns, uint64_t rows) {
  return columns >= 2 && rows >= 2 && columns <= kMostSamples && rows <= kMostSamples / columns;
}

// MuJoCo's own format: the counts of rows and columns as int32, then the samples as float32.
void read_file(const std::string& path, const Xml& element, Samples& out, FirstError& errors) {
  const Result<File> file = File::open(path, "a height field");
  if (!file) return errors.add(element, file.error().message);
  std::array<int32_t, 2> counts{};
  Result<void> done = file->read_at(0, std::as_writable_bytes(std::span(counts)), path);
  if (!done) return errors.add(element, done.error().message);
  out.rows = static_cast<uint64_t>(std::max(counts[0], 0));
  out.columns = static_cast<uint64_t>(std::max(counts[1], 0));
  const Result<uint64_t> size = file->size(path);
  if (!size) return errors.add(element, size.error().message);
  const uint64_t bytes = *size - sizeof counts, samples = bytes / sizeof(float);
  const bool is_whole = samples == out.columns * out.rows && bytes % sizeof(float) == 0;
  if (!are_in_range(out.columns, out.rows) || !is_whole) {
    return errors.add(element, quoted_name(path) + " is no height field of MuJoCo's: it says " +
                                   std::to_string(counts[0]) + " rows of " +
                                   std::to_string(counts[1]) + " samples, and holds " +
                                   std::to_string(bytes) + " bytes of them");
  }
  out.values.resize(samples);
  done = file->read_at(sizeof counts, std::as_writable_bytes(std::span(out.values)), path);
  if (!done) errors.add(element, done.error().message);
}

uint64_t read_count(const Xml& element, const char* attribute, FirstError& errors) {
  const std::vector<double> number = numbers_of(element, attribute, 1, 1, errors);
  const bool is_count = number.size() == 1 && number[0] == std::floor(number[0]) &&
                        number[0] >= 2 && number[0] <= double{kMostSamples};
  if (!is_count) errors.add(element, std::string(attribute) + " must be a whole number above 1");
  return is_count ? static_cast<uint64_t>(number[0]) : 0;
}

// The rows of the attribute run from the greatest y downwards. Without it all samples are zero.
void read_elevation(const Xml& element, Samples& out, FirstError& errors) {
  out.rows = read_count(element, "nrow", errors);
  out.columns = read_count(element, "ncol", errors);
  if (errors.is_there()) return;
  if (!are_in_range(out.columns, out.rows)) return errors.add(element, "has too many samples");
  const size_t count = out.rows * out.columns;
  const std::vector<double> given = numbers_of(element, "elevation", 0, ~size_t{0}, errors);
  if (!given.empty() && given.size() != count) {
    return errors.add(element, "elevation has " + std::to_string(given.size()) + " numbers for " +
                                   std::to_string(out.rows) + " rows of " +
                                   std::to_string(out.columns));
  }
  out.values.assign(count, 0);
  for (size_t i = 0; i < given.size(); ++i) {
    const size_t row = out.rows - 1 - i / out.columns;
    out.values[row * out.columns + i % out.columns] = static_cast<float>(given[i]);
  }
}

// Scales the samples to 0 to 1, as MuJoCo does. False if they are not finite.
bool normalize(std::vector<float>& values) {
  const bool are_finite =
      std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
  if (!are_finite) return false;
  const float least = *std::min_element(values.begin(), values.end());
  const float range = *std::max_element(values.begin(), values.end()) - least;
  for (float& v : values) v = range > 0 ? (v - least) / range : 0;
  return std::isfinite(range);
}

std::shared_ptr<const ModelHeights> read(const Xml& element, const std::filesystem::path& folder,
                                         const MjcfSettings& settings, FirstError& errors) {
  Samples samples;
  if (std::filesystem::path path = attribute_of(element, "file"); path.empty()) {
    read_elevation(element, samples, errors);
  } else if (has_extension(path.string(), ".png")) {
    errors.add(element,
               "images are not read: state the samples as elevation, or in MuJoCo's "
               "binary format");
  } else {
    if (settings.strips_paths) path = path.filename();
    read_file((folder / (settings.mesh_folder / path)).string(), element, samples, errors);
  }
  const std::vector<double> size = numbers_of(element, "size", 4, 4, errors);
  const bool is_sized =
      size.size() == 4 && std::all_of(size.begin(), size.end(), [](double s) { return s > 0; });
  if (!is_sized) errors.add(element, "size must be four numbers above 0");
  if (errors.is_there()) return nullptr;
  if (!normalize(samples.values)) {
    errors.add(element, "has samples that are not finite");
    return nullptr;
  }
  auto heights = std::make_shared<ModelHeights>();
  const auto columns = static_cast<float>(samples.columns), rows = static_cast<float>(samples.rows);
  heights->params = {columns, rows, static_cast<float>(2 * size[0] / double(samples.columns - 1)),
                     static_cast<float>(2 * size[1] / double(samples.rows - 1))};
  heights->samples = std::move(samples.values);
  for (float& h : heights->samples) h = static_cast<float>(h * size[2]);
  return heights;
}

}  // namespace

void MjcfHeightFields::add(const Xml& element, FirstError& errors) {
  expect_attributes(element, {"name", "content_type", "file", "nrow", "ncol", "elevation", "size"},
                    errors);
  std::string name = attribute_of(element, "name");
  if (name.empty()) name = stem_of(attribute_of(element, "file"));
  if (!assets_.emplace(name, Asset{&element, nullptr}).second) {
    errors.add(element, "there is another height field " + quoted_name(name));
  }
}

std::shared_ptr<const ModelHeights> MjcfHeightFields::get(const std::string& name,
                                                          const std::filesystem::path& folder,
                                                          const MjcfSettings& settings,
                                                          const Xml& geom, FirstError& errors) {
  const auto found = assets_.find(name);
  if (found == assets_.end()) {
    errors.add(geom, "there is no height field " + quoted_name(name));
    return nullptr;
  }
  Asset& asset = found->second;
  if (asset.heights == nullptr) asset.heights = read(*asset.element, folder, settings, errors);
  return asset.heights;
}

}  // namespace carom::io
