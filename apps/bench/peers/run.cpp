#include "apps/bench/peers/run.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/base/heap.hpp"

namespace signorini::bench {
namespace {

/// Memory that a child process shares with this one.
class SharedResult {
 public:
  struct Header {
    double seconds;
    int iterations;
    bool done;
    char failure[200];
  };

  explicit SharedResult(std::size_t unknowns)
      : bytes_(sizeof(Header) + unknowns * sizeof(double)), unknowns_(unknowns) {
    memory_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::runtime_error("no memory to share with a process");
  }
  SharedResult(const SharedResult&) = delete;
  SharedResult& operator=(const SharedResult&) = delete;
  ~SharedResult() { munmap(memory_, bytes_); }

  Header& header() { return *static_cast<Header*>(memory_); }

  void store(const Attempt& attempt) {
    header().seconds = attempt.seconds;
    header().iterations = attempt.iterations;
    header().done = attempt.x.size() == unknowns_;
    if (header().done) std::memcpy(values(), attempt.x.data(), unknowns_ * sizeof(double));
  }

  Attempt load() { return {header().seconds, header().iterations, {values(), values() + unknowns_}}; }

 private:
  double* values() { return reinterpret_cast<double*>(static_cast<char*>(memory_) + sizeof(Header)); }

  void* memory_;
  std::size_t bytes_, unknowns_;
};

void solve_into(SharedResult& result, const Solver& solver, double tolerance) {
  keep_freed_memory();
  try {
    result.store(solver(tolerance));
  } catch (const std::exception& error) {
    std::strncpy(result.header().failure, error.what(), sizeof(SharedResult::Header::failure) - 1);
  }
}

/// Ends this process after that much processor time, and with its parent.
void limit_process(double seconds) {
  const auto whole = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit limit{whole, whole + 1};
  setrlimit(RLIMIT_CPU, &limit);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
}

}  // namespace

Measurement run_apart(const Solver& solver, std::size_t size, double tolerance, double limit) {
  SharedResult result(size);
  malloc_trim(0);
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    limit_process(limit);
    solve_into(result, solver, tolerance);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Measurement out;
  out.tolerance = tolerance;
  out.too_slow = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  if (out.too_slow)
    out.failure = "too slow";
  else if (result.header().done)
    out.attempt = result.load();
  else
    out.failure = result.header().failure[0] ? result.header().failure : "crashed";
  return out;
}

namespace {

void judge(Measurement& m, const NaturalResidual& residual, const SparseRows& A, const Reference& reference) {
  if (!m.solved()) return;
  m.residual = residual(m.attempt.x.data());
  m.error = energy_error(A, m.attempt.x, reference);
  if (!(m.residual <= demanded_residual && m.error <= demanded_error))
    m.failure = fmt::format("not accurate: error {:.1e}, residual {:.1e}", m.error, m.residual);
}

}  // namespace

Measurement measure(const Solver& solver, const QuadraticProgram& program, const Reference& reference,
                    const Patience& patience) {
  constexpr double loosest = 1e-6, tightest = 1e-14;
  const NaturalResidual residual(program);
  const std::size_t unknowns = program.b.size();
  double left = patience.seconds;
  Measurement out;
  double tolerance = loosest;
  for (;; tolerance /= 10) {
    Measurement next = run_apart(solver, unknowns, tolerance, left);
    left -= next.attempt.seconds;
    next.too_slow = next.too_slow || left <= 0;
    // A tighter tolerance that cannot be reached leaves the last answer as the solver's best.
    const bool gave_nothing = next.attempt.x.empty() && !next.too_slow && !out.attempt.x.empty();
    if (gave_nothing) return out;
    out = std::move(next);
    judge(out, residual, program.A, reference);
    if (out.solved() || out.too_slow || out.attempt.x.empty() || tolerance <= 1.5 * tightest) break;
  }
  if (out.too_slow) out.failure = fmt::format("> {:g} s", patience.seconds);
  for (int run = 1; run < patience.repeats && out.solved() && out.attempt.seconds < patience.is_short; ++run) {
    Measurement again = run_apart(solver, unknowns, tolerance, patience.seconds);
    judge(again, residual, program.A, reference);
    if (again.solved() && again.attempt.seconds < out.attempt.seconds) out = std::move(again);
  }
  return out;
}

}  // namespace signorini::bench
