#pragma once
#include <array>
#include <string_view>

#include "core/base/types.hpp"

namespace signorini {

/// A Matrix Market file in memory, read line by line.
class MatrixMarketInput {
 public:
  struct Entry {
    Index row, column;  ///< from 0
    double value;       ///< perhaps infinite, never NaN
  };

  /// Reads the header, up to the line with the sizes.
  MatrixMarketInput(std::string_view text, std::string_view place);

  Index rows() const { return rows_; }
  Index columns() const { return columns_; }
  bool symmetric() const { return symmetric_; }
  bool coordinate() const { return coordinate_; }
  Offset entries() const { return entries_; }  ///< in the file: no more than its size allows

  /// Calls visit(Entry) for each entry. Of a symmetric matrix the file holds the lower triangle.
  template <class Visit>
  void for_each_entry(const Visit& visit) {
    Index row = 0, column = 0;
    for (Offset k = 0; k < entries_; ++k) {
      next_line(k);
      if (coordinate_) {
        visit(coordinate_entry());
        continue;
      }
      visit(Entry{row, column, array_value()});
      if (++row == rows_) row = symmetric_ ? ++column : (++column, 0);
    }
    expect_end();
  }

  /// Error(Exit::input) naming the line read last.
  [[noreturn]] void fail(std::string_view message) const;

 private:
  using Words = std::array<std::string_view, 5>;

  bool next_line();
  void next_line(Offset entries_so_far);
  std::size_t split(Words& words) const;
  void read_banner();
  void read_sizes();
  Entry coordinate_entry() const;
  double array_value() const;
  double value(std::string_view word) const;
  Index number(std::string_view word, Index least, Index most, const char* meaning) const;
  void expect_end();

  std::string_view text_, place_, line_;
  std::size_t position_ = 0;
  Offset line_number_ = 0;
  bool coordinate_ = false, integer_ = false, symmetric_ = false;
  Index rows_ = 0, columns_ = 0;
  Offset entries_ = 0;
};

}  // namespace signorini
