// Memory for the geometries of k-DOPs. Those made one after the other lie side by side, without all
// else that each of them allocates: processors foresee which lines tests read next.
#pragma once

#include <cstddef>
#include <mutex>

namespace carom {

// Places of one size in large blocks. Any thread may call it. Empty blocks are freed but for one,
// since whoever makes and drops single objects would have a block made for each.
class PlacesInBlocks {
 public:
  static constexpr size_t kBytesOfBlock = size_t{1} << 17;
  static constexpr size_t kAlignment = 64;

  // `bytes` of each place; many fit into a block.
  explicit PlacesInBlocks(size_t bytes);
  // No place is taken.
  ~PlacesInBlocks();
  PlacesInBlocks(const PlacesInBlocks&) = delete;
  PlacesInBlocks& operator=(const PlacesInBlocks&) = delete;

  void* take();
  void give_back(void* place);

  size_t places_of_block() const { return places_of_block_; }

 private:
  struct Block;

  void add(Block* block);
  void remove(Block* block);
  void free_spare();

  const size_t bytes_, places_of_block_;
  std::mutex mutex_;
  Block* with_room_ = nullptr;  // the first of them
  Block* spare_ = nullptr;      // of these, the empty one
};

// An allocator for std::allocate_shared().
template <class T>
struct SideBySide {
  using value_type = T;

  SideBySide() = default;
  template <class U>
  explicit(false) SideBySide(const SideBySide<U>&) {}

  T* allocate(size_t) { return static_cast<T*>(places().take()); }
  void deallocate(T* object, size_t) { places().give_back(object); }
  bool operator==(const SideBySide&) const { return true; }

 private:
  // Never destroyed, as objects of the program may live until its very end.
  static PlacesInBlocks& places() {
    static_assert(alignof(T) <= PlacesInBlocks::kAlignment);
    static auto& all = *new PlacesInBlocks(sizeof(T));
    return all;
  }
};

}  // namespace carom
