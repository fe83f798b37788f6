// NumPy .npz archives (zip of .npy members, stored or deflated).
//
// Every error is one line: "FILE: member NAME: what is wrong (what was expected)".
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "carom/base/result.h"
#include "io/files/atomic_file.h"
#include "io/files/file.h"
#include "io/files/npy.h"

namespace carom::io {

// An error "path: member name: text".
Error member_error(const std::string& path, const std::string& name, const std::string& text);

// The type and shape that a reader expects of one member. Extents may be kAny.
struct Expected {
  DType dtype;
  Shape shape;
};

// Appends the extent of a row type such as std::array<float, 3> to `shape`.
template <class T>
Expected expected_of(Shape shape) {
  if constexpr (NpyElement<T>::kWidth != 0) shape.push_back(NpyElement<T>::kWidth);
  return {NpyElement<T>::kDType, std::move(shape)};
}

// Reads one member from its first byte to its last, in pieces. Streams of one archive may be used
// in turn but not from several threads at once.
class NpzStream {
 public:
  NpzStream();
  NpzStream(NpzStream&&) noexcept;
  NpzStream& operator=(NpzStream&&) noexcept;
  ~NpzStream();

  const NpyHeader& header() const;
  uint64_t data_bytes() const;
  uint64_t bytes_left() const;

  // Fills `out`; asking for more than bytes_left() is an error. Reading the last byte also checks
  // the member's checksum and length.
  Result<void> read(std::span<std::byte> out);
  // Back to the first byte of the data.
  Result<void> rewind();

 private:
  friend class NpzReader;
  struct State;
  explicit NpzStream(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

class NpzReader {
 public:
  static Result<NpzReader> open(const std::string& path);
  NpzReader(NpzReader&&) noexcept;
  NpzReader& operator=(NpzReader&&) noexcept;
  ~NpzReader();

  const std::string& path() const;
  // Names of the arrays (without ".npy"), in the order of the archive.
  const std::vector<std::string>& members() const;
  bool has(const std::string& name) const;
  Result<NpyHeader> header(const std::string& name) const;

  // A whole member. T is a scalar or a row (std::array): read<std::array<float, 3>>(name, {kAny})
  // reads float32 of shape (any, 3).
  template <class T>
  Result<std::vector<T>> read(const std::string& name, Shape expected) const;

  // Opens a member of the expected type and shape for reading in pieces.
  Result<NpzStream> stream(const std::string& name, const Expected& expected) const;
  // The same for any type and shape.
  Result<NpzStream> stream(const std::string& name) const;

 private:
  struct State;
  explicit NpzReader(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
  friend class NpzStream;
};

enum class Compression : uint8_t { kStored, kDeflated };

// Writes an archive to a temporary file in the target's folder; finish() gives it the target's
// name. If finish() fails or is never called, no file is left.
class NpzWriter {
 public:
  static Result<NpzWriter> create(const std::string& path,
                                  Compression compression = Compression::kStored);
  NpzWriter(NpzWriter&&) noexcept;
  NpzWriter& operator=(NpzWriter&&) noexcept;
  ~NpzWriter();

  // Copies a whole array; the product of `shape` must be the number of values.
  template <class T>
  Result<void> add(const std::string& name, std::span<const T> values, const Shape& shape);
  // One row type or scalar per element of the vector: shape (size[, width]).
  template <class T>
  Result<void> add(const std::string& name, const std::vector<T>& values);

  // Starts an array of shape (rows, row...). finish() sets the first extent; until then an unnamed
  // file keeps the data. Returns the index that append() takes. Each append() may add any part of
  // the data, or one row if a row has no bytes.
  Result<size_t> begin(const std::string& name, DType dtype, const Shape& row);
  Result<void> append(size_t member, std::span<const std::byte> bytes);

  Result<void> finish();

 private:
  struct State;
  explicit NpzWriter(std::unique_ptr<State> state);
  Result<void> add_bytes(const std::string& name, const NpyHeader& header,
                         std::span<const std::byte> bytes);
  std::unique_ptr<State> state_;
};

template <class T>
Result<std::vector<T>> NpzReader::read(const std::string& name, Shape expected) const {
  Result<NpzStream> opened = stream(name, expected_of<T>(std::move(expected)));
  if (!opened) return opened.error();
  std::vector<T> values(opened->data_bytes() / sizeof(T));
  Result<void> done = opened->read(std::as_writable_bytes(std::span<T>(values)));
  if (!done) return done.error();
  return values;
}

template <class T>
Result<void> NpzWriter::add(const std::string& name, std::span<const T> values,
                            const Shape& shape) {
  return add_bytes(name, {NpyElement<T>::kDType, false, shape}, std::as_bytes(values));
}

template <class T>
Result<void> NpzWriter::add(const std::string& name, const std::vector<T>& values) {
  Expected layout = expected_of<T>({values.size()});
  return add_bytes(name, {layout.dtype, false, layout.shape},
                   std::as_bytes(std::span<const T>(values)));
}

}  // namespace carom::io
