// Runs of a list that go to other places of the same list.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

namespace carom {

struct ListMove {
  size_t from, to;  // places in the list
  size_t count;
};

// Moves the runs, as bytes. They must not overlap, neither where they are nor where they go to, and
// both must ascend. Then runs that go down, in their order, and after them those that go up, from
// the last one on, overwrite none that is still to be moved.
template <class T>
void move_runs(std::span<const ListMove> moves, T* items) {
  const auto move = [items](const ListMove& run) {
    std::memmove(static_cast<void*>(items + run.to), items + run.from, run.count * sizeof(T));
  };
  for (const ListMove& run : moves) {
    if (run.to < run.from) move(run);
  }
  for (size_t i = moves.size(); i > 0; --i) {
    if (moves[i - 1].to > moves[i - 1].from) move(moves[i - 1]);
  }
}

}  // namespace carom
