// Makes inputs when the first benchmark needs them.
#pragma once

#include <memory>

namespace carom::bench {

// The T made from `key`. It is kept until another key is asked for.
template <class T, class Key>
const T& cached(const Key& key) {
  static std::unique_ptr<Key> last_key;
  static std::unique_ptr<T> last;
  if (!last_key || !(*last_key == key)) {
    last.reset();
    last = std::make_unique<T>(key);
    last_key = std::make_unique<Key>(key);
  }
  return *last;
}

}  // namespace carom::bench
