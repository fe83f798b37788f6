// The header of a NumPy .npy array (format versions 1 to 3): parsing and printing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "carom/base/result.h"

namespace carom::io {

enum class DType : uint8_t {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
};

size_t dtype_size(DType dtype);
const char* dtype_name(DType dtype);  // as NumPy names it: "float32"

// The dtype of a C++ type, and the extents it adds to a shape: a std::array<float, 3> is a row of
// three float32.
template <class T>
struct NpyElement;
template <DType kType>
struct NpyScalar {
  static constexpr DType kDType = kType;
  static constexpr size_t kWidth = 0;  // a scalar adds no extent
};
template <>
struct NpyElement<uint8_t> : NpyScalar<DType::kUint8> {};
template <>
struct NpyElement<int32_t> : NpyScalar<DType::kInt32> {};
template <>
struct NpyElement<uint32_t> : NpyScalar<DType::kUint32> {};
template <>
struct NpyElement<uint64_t> : NpyScalar<DType::kUint64> {};
template <>
struct NpyElement<float> : NpyScalar<DType::kFloat32> {};
template <>
struct NpyElement<double> : NpyScalar<DType::kFloat64> {};
template <class T, size_t kCount>
struct NpyElement<std::array<T, kCount>> {
  static constexpr DType kDType = NpyElement<T>::kDType;
  static constexpr size_t kWidth = kCount;
};

using Shape = std::vector<uint64_t>;

// In an expected shape: any extent.
inline constexpr uint64_t kAny = UINT64_MAX;

struct NpyHeader {
  DType dtype = DType::kUint8;
  bool fortran_order = false;
  Shape shape;
};

// Reads the text between the length field and the data. Refuses big-endian, structured and other
// unknown dtypes, and anything that is not exactly the three keys NumPy writes.
Result<NpyHeader> parse_npy_dict(std::string_view text);

// The first bytes of a .npy file hold the magic, the version and the length of the text.
inline constexpr size_t kNpyPrefixBytes = 12;
inline constexpr size_t kMaxNpyHeaderBytes = 65536;
struct NpyPrefix {
  size_t text_begin;  // 10 or 12
  size_t text_bytes;  // at most kMaxNpyHeaderBytes
};
Result<NpyPrefix> parse_npy_prefix(std::span<const std::byte> bytes);

// A version 1 header, padded to a multiple of 64 bytes and to at least `min_bytes`.
std::string print_npy_header(const NpyHeader& header, size_t min_bytes = 0);

// Bytes of the array's data; an error if that does not fit 63 bits.
Result<uint64_t> npy_data_bytes(const NpyHeader& header);

// "(30, 1000, 3)"; kAny prints as "any".
std::string shape_text(const Shape& shape);
// True if both have the same number of extents and agree wherever `expected` is not kAny.
bool shape_matches(const Shape& shape, const Shape& expected);

}  // namespace carom::io
