#pragma once
#include <sys/mman.h>
#include <unistd.h>

namespace signorini::bench {

/// Touches half of the free memory and gives it back. On a virtual machine the first touch of a page can take the host
/// longer than all that is done with it afterwards: whichever solver came first would pay for that.
inline void warm_memory() {
  const auto size = static_cast<std::size_t>(sysconf(_SC_AVPHYS_PAGES)) / 2 * sysconf(_SC_PAGESIZE);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  if (memory != MAP_FAILED) munmap(memory, size);
}

}  // namespace signorini::bench
