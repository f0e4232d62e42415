#include "core/base/heap.hpp"

#include <cstdint>
#include <cstdlib>

#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__
#endif
#endif

// A sanitizer has a heap of its own.
#if defined(__GLIBC__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

namespace signorini {

namespace {

// All of the heap at once, so that the advice holds for all of it; what is freed stays part of it.
void reserve_huge_pages() {
  constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21;
  const auto size = static_cast<std::uintptr_t>(sysconf(_SC_PHYS_PAGES)) / 2 * sysconf(_SC_PAGESIZE);
  void* heap = std::malloc(size);
  const auto begin = reinterpret_cast<std::uintptr_t>(heap);
  const std::uintptr_t first = (begin + huge_page - 1) / huge_page * huge_page;
  if (heap && first < begin + size) madvise(reinterpret_cast<void*>(first), begin + size - first, MADV_HUGEPAGE);
  std::free(heap);
}

}  // namespace

void prepare_heap() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  reserve_huge_pages();
}

}  // namespace signorini

#else

void signorini::prepare_heap() {}

#endif
