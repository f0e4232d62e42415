#pragma once
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <memory>
#include <new>
#include <span>

namespace signorini::conformance {

/// Room for so many objects, behind which no memory is: whoever reads or writes there ends the program.
template <class T>
class Guarded {
 public:
  explicit Guarded(std::size_t count) : count_(count) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t bytes = (count * sizeof(T) + page - 1) / page * page;
    length_ = bytes + page;
    memory_ = mmap(nullptr, length_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    mprotect(static_cast<char*>(memory_) + bytes, page, PROT_NONE);
    first_ = reinterpret_cast<T*>(static_cast<char*>(memory_) + bytes - count * sizeof(T));
    std::uninitialized_value_construct_n(first_, count);
  }
  ~Guarded() { munmap(memory_, length_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  T* data() { return first_; }
  std::span<T> all() { return {first_, count_}; }

 private:
  std::size_t count_, length_ = 0;
  void* memory_ = nullptr;
  T* first_ = nullptr;
};

}  // namespace signorini::conformance
