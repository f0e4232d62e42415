#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace signorini::conformance {

/// What a piece of work in a copy of the process tells this one.
class Copy {
 public:
  Copy();
  ~Copy();
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

  /// Of the copy: what it has found, at most some thousand letters of it.
  void tell(std::string_view text) const;
  /// Of the copy: which of its questions it is about to ask.
  void note(long question) const;

  /// Does `work` in a copy of this process.
  /// @return "" where it came to its end, else how it ended: "a crash (...)", "no end within 10 seconds"
  std::string run(const std::function<void()>& work, double patience = 10);

  std::string told() const;
  long noted() const;

 private:
  struct Shared;
  Shared* shared_;
};

}  // namespace signorini::conformance
