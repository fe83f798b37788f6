// A 64-bit hash of all results of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

namespace carom::cli {

class StateHash {
 public:
  // Hashes the length too, so that moving an element to the next list changes the hash.
  template <class T>
  void add(std::span<const T> list) {
    mix(list.size());
    add_bytes(std::as_bytes(list));
  }

  std::string text() const;  // 16 hexadecimal digits

 private:
  void add_bytes(std::span<const std::byte> bytes) {
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) mix_bytes(bytes.first(8));
    if (!bytes.empty()) mix_bytes(bytes);
  }

  void mix_bytes(std::span<const std::byte> bytes) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data(), bytes.size());
    mix(word);
  }

  // A bijection of the state for every word.
  void mix(uint64_t word) {
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15u;
    state_ ^= state_ >> 32;
  }

  uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace carom::cli
