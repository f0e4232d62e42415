#include "core/base/interrupt.hpp"

#include <atomic>

namespace signorini {
namespace {
std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);
}  // namespace

bool interrupt_requested() noexcept { return requested.load(std::memory_order_relaxed); }
void request_interrupt() noexcept { requested.store(true, std::memory_order_relaxed); }

}  // namespace signorini
