// How often each test decided, counted by every thread.
#pragma once

#include <atomic>
#include <cstddef>

namespace starcell {

struct Statistics {
  std::atomic<std::size_t> cells{0}, leaves{0}, empty{0}, max_depth{0};
  std::atomic<std::size_t> face_link{0}, face_planes{0}, face_split{0}, face_cone{0}, face_star{0};
  std::atomic<std::size_t> voxel_link{0}, voxel_cone{0}, voxel_planes{0}, voxel_star{0}, voxel_complex{0}, voxel_patches{0};
  std::atomic<std::size_t> guard_witness{0}, guard_program{0}, guard_failed{0};
};

inline void count(std::atomic<std::size_t>& counter) { counter.fetch_add(1, std::memory_order_relaxed); }

}  // namespace starcell
