#include "shapes/dop_memory.h"

#include <cassert>
#include <cstdint>
#include <new>

namespace carom {

// Stands at the beginning of its memory; the places follow.
struct alignas(PlacesInBlocks::kAlignment) PlacesInBlocks::Block {
  // A place that was given back.
  struct Free {
    Free* next;
  };

  // In the list of blocks with room.
  Block* next = nullptr;
  Block* last = nullptr;
  Free* free = nullptr;
  size_t begun = 0;  // places that have been taken before
  size_t taken = 0;  // places that are taken now

  // Blocks are aligned to their size.
  static Block* of(void* place) {
    return reinterpret_cast<Block*>(reinterpret_cast<uintptr_t>(place) & ~(kBytesOfBlock - 1));
  }
};

namespace {

constexpr std::align_val_t kAlignedToBlocks{PlacesInBlocks::kBytesOfBlock};

size_t padded_bytes(size_t bytes) {
  constexpr size_t kAlignment = PlacesInBlocks::kAlignment;
  return (bytes + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace

PlacesInBlocks::PlacesInBlocks(size_t bytes)
    : bytes_(padded_bytes(bytes)), places_of_block_((kBytesOfBlock - sizeof(Block)) / bytes_) {
  assert(places_of_block_ > 1);
}

PlacesInBlocks::~PlacesInBlocks() {
  free_spare();
  assert(!with_room_);
}

void* PlacesInBlocks::take() {
  const std::lock_guard lock(mutex_);
  if (!with_room_) add(new (::operator new(kBytesOfBlock, kAlignedToBlocks)) Block);
  Block* const block = with_room_;
  if (block == spare_) spare_ = nullptr;
  void* place = block->free;
  if (place) {
    block->free = block->free->next;
  } else {
    place = reinterpret_cast<char*>(block + 1) + bytes_ * block->begun++;
  }
  if (++block->taken == places_of_block_) remove(block);
  return place;
}

void PlacesInBlocks::give_back(void* place) {
  const std::lock_guard lock(mutex_);
  Block* const block = Block::of(place);
  block->free = new (place) Block::Free{block->free};
  if (block->taken-- == places_of_block_) add(block);
  if (block->taken > 0) return;
  free_spare();
  spare_ = block;
}

void PlacesInBlocks::free_spare() {
  if (!spare_) return;
  remove(spare_);
  ::operator delete(spare_, kAlignedToBlocks);
  spare_ = nullptr;
}

void PlacesInBlocks::add(Block* block) {
  block->next = with_room_;
  block->last = nullptr;
  if (with_room_) with_room_->last = block;
  with_room_ = block;
}

void PlacesInBlocks::remove(Block* block) {
  (block->last ? block->last->next : with_room_) = block->next;
  if (block->next) block->next->last = block->last;
}

}  // namespace carom
