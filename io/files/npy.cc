#include "io/files/npy.h"

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>

#include "io/printable.h"

namespace carom::io {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are read as they lie in memory");

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr size_t kAlignment = 64;

struct DTypeEntry {
  const char* code;  // in the header, after the byte order
  const char* name;
  size_t size;
};

// In the order of DType.
constexpr DTypeEntry kDTypes[] = {
    {"b1", "bool", 1},   {"i1", "int8", 1},    {"u1", "uint8", 1},   {"i2", "int16", 2},
    {"u2", "uint16", 2}, {"i4", "int32", 4},   {"u4", "uint32", 4},  {"i8", "int64", 8},
    {"u8", "uint64", 8}, {"f4", "float32", 4}, {"f8", "float64", 8},
};

const DTypeEntry& entry(DType dtype) { return kDTypes[static_cast<size_t>(dtype)]; }

Error header_error(const std::string& text) { return {"has a bad .npy header: " + text}; }

// A cursor over the Python dictionary literal.
class DictParser {
 public:
  explicit DictParser(std::string_view text) : rest_(text) {}

  bool accept(char c) {
    skip_space();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool accept_word(std::string_view word) {
    skip_space();
    if (!rest_.starts_with(word)) return false;
    rest_.remove_prefix(word.size());
    return true;
  }

  std::optional<std::string_view> quoted() {
    skip_space();
    if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return std::nullopt;
    const size_t end = rest_.find(rest_.front(), 1);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view text = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return text;
  }

  std::optional<uint64_t> extent() {
    skip_space();
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || value == kAny) return std::nullopt;
    rest_.remove_prefix(static_cast<size_t>(end - rest_.data()));
    return value;
  }

  bool at_end() {
    skip_space();
    return rest_.empty();
  }

 private:
  void skip_space() {
    const size_t begin = rest_.find_first_not_of(" \t\n\r");
    rest_.remove_prefix(begin == std::string_view::npos ? rest_.size() : begin);
  }

  std::string_view rest_;
};

Result<DType> parse_descr(std::string_view descr) {
  const std::string quoted = quoted_name(descr);
  if (descr.size() < 2) return header_error("unknown dtype " + quoted);
  const std::string_view code = descr.substr(1);
  for (size_t i = 0; i < std::size(kDTypes); ++i) {
    if (code != kDTypes[i].code) continue;
    const char order = descr.front();
    if (order == '>' && kDTypes[i].size > 1) {
      return Error{"has the big-endian dtype " + quoted + " (little endian was expected)"};
    }
    if (std::string_view("<|=>").find(order) == std::string_view::npos) break;
    return static_cast<DType>(i);
  }
  return header_error("unknown dtype " + quoted);
}

Result<Shape> parse_shape(DictParser& parser) {
  if (!parser.accept('(')) return header_error("'shape' is no tuple");
  Shape shape;
  while (!parser.accept(')')) {
    const std::optional<uint64_t> extent = parser.extent();
    if (!extent) return header_error("'shape' holds something other than sizes");
    shape.push_back(*extent);
    if (parser.accept(',')) continue;
    if (shape.size() < 2 || !parser.accept(')')) return header_error("'shape' is no tuple");
    break;
  }
  return shape;
}

}  // namespace

size_t dtype_size(DType dtype) { return entry(dtype).size; }
const char* dtype_name(DType dtype) { return entry(dtype).name; }

Result<NpyHeader> parse_npy_dict(std::string_view text) {
  DictParser parser(text);
  if (!parser.accept('{')) return header_error("no dictionary");
  std::optional<DType> dtype;
  std::optional<bool> fortran_order;
  std::optional<Shape> shape;
  while (!parser.accept('}')) {
    const std::optional<std::string_view> key = parser.quoted();
    if (!key || !parser.accept(':')) return header_error("a key was expected");
    if (*key == "descr" && !dtype) {
      const std::optional<std::string_view> descr = parser.quoted();
      if (!descr) return header_error("'descr' is no simple dtype");
      Result<DType> parsed = parse_descr(*descr);
      if (!parsed) return parsed.error();
      dtype = *parsed;
    } else if (*key == "fortran_order" && !fortran_order) {
      if (parser.accept_word("True")) {
        fortran_order = true;
      } else if (parser.accept_word("False")) {
        fortran_order = false;
      } else {
        return header_error("'fortran_order' is neither True nor False");
      }
    } else if (*key == "shape" && !shape) {
      Result<Shape> parsed = parse_shape(parser);
      if (!parsed) return parsed.error();
      shape = std::move(*parsed);
    } else {
      return header_error("unknown or repeated key " + quoted_name(*key));
    }
    if (parser.accept(',')) continue;
    if (!parser.accept('}')) return header_error("the dictionary does not end");
    break;
  }
  if (!parser.at_end()) return header_error("text after the dictionary");
  if (!dtype || !fortran_order || !shape) {
    return header_error("a key is missing ('descr', 'fortran_order' and 'shape' were expected)");
  }
  return NpyHeader{*dtype, *fortran_order, std::move(*shape)};
}

Result<NpyPrefix> parse_npy_prefix(std::span<const std::byte> bytes) {
  const auto byte = [&](size_t i) { return std::to_integer<size_t>(bytes[i]); };
  if (bytes.size() < 10 || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    return Error{"is not a .npy array (the magic \\x93NUMPY was expected)"};
  }
  const size_t major = byte(6);
  if (major < 1 || major > 3) {
    return header_error("version " + std::to_string(major) + " (1, 2 or 3 was expected)");
  }
  NpyPrefix prefix{10, byte(8) | byte(9) << 8};
  if (major > 1) {
    if (bytes.size() < kNpyPrefixBytes) return header_error("it ends early");
    prefix = {12, prefix.text_bytes | byte(10) << 16 | byte(11) << 24};
  }
  if (prefix.text_bytes > kMaxNpyHeaderBytes) {
    return header_error("its length is " + std::to_string(prefix.text_bytes) + " (at most " +
                        std::to_string(kMaxNpyHeaderBytes) + " was expected)");
  }
  return prefix;
}

std::string print_npy_header(const NpyHeader& header, size_t min_bytes) {
  const DTypeEntry& dtype = entry(header.dtype);
  std::string text = "{'descr': '";
  text += dtype.size > 1 ? '<' : '|';
  text += dtype.code;
  text += "', 'fortran_order': ";
  text += header.fortran_order ? "True" : "False";
  text += ", 'shape': " + shape_text(header.shape) + ", }";

  const size_t used = kMagic.size() + 4 + text.size() + 1;  // version, length, final newline
  const size_t padded = (used + kAlignment - 1) / kAlignment * kAlignment;
  text.append((padded > min_bytes ? padded : min_bytes) - used, ' ');
  text += '\n';

  std::string out(kMagic);
  out += {'\1', '\0', static_cast<char>(text.size() & 0xff), static_cast<char>(text.size() >> 8)};
  return out + text;
}

Result<uint64_t> npy_data_bytes(const NpyHeader& header) {
  for (const uint64_t extent : header.shape) {
    if (extent == 0) return uint64_t{0};
  }
  uint64_t bytes = dtype_size(header.dtype);
  for (const uint64_t extent : header.shape) {
    if (extent > static_cast<uint64_t>(INT64_MAX) / bytes) {
      return Error{"is absurdly large: shape " + shape_text(header.shape) + " of " +
                   dtype_name(header.dtype) + " (less than 2^63 bytes was expected)"};
    }
    bytes *= extent;
  }
  return bytes;
}

std::string shape_text(const Shape& shape) {
  std::string text = "(";
  for (size_t i = 0; i < shape.size(); ++i) {
    if (i > 0) text += ", ";
    text += shape[i] == kAny ? "any" : std::to_string(shape[i]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

bool shape_matches(const Shape& shape, const Shape& expected) {
  if (shape.size() != expected.size()) return false;
  for (size_t i = 0; i < shape.size(); ++i) {
    if (expected[i] != kAny && shape[i] != expected[i]) return false;
  }
  return true;
}

}  // namespace carom::io
