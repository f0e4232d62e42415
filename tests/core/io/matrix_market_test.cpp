#include "core/io/matrix_market.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"
#include "tests/core/mesh/mesh_checks.hpp"
#include "tests/support/folder.hpp"

namespace signorini {
namespace {

using test::input_error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string coordinate = "%%MatrixMarket matrix coordinate real general\n";
const std::string array = "%%MatrixMarket matrix array real general\n";

SparseRows matrix(const std::string& text) { return parse_matrix(text, "A.mtx"); }
std::vector<double> vector(const std::string& text, Index size, Infinities infinities = Infinities::refused) {
  return parse_vector(text, "b.mtx", size, infinities);
}

/// Dense, row by row.
std::vector<double> dense(const SparseRows& A) {
  std::vector<double> out(static_cast<std::size_t>(A.rows * A.columns), 0);
  for (Index i = 0; i < A.rows; ++i)
    for (Offset k = A.row[i]; k < A.row[i + 1]; ++k) out[i * A.columns + A.column[k]] += A.value[k];
  return out;
}

TEST(MatrixMarket, ReadsCoordinatesInAnyOrder) {
  const SparseRows A = matrix(coordinate + "% a comment\n%\n\n2 3 4\n2 3 -1.5e0\n1 1 +4\n\n1\t2  .5\r\n2 2 7.");
  EXPECT_EQ(A.columns, 3);
  EXPECT_THAT(dense(A), ElementsAre(4, 0.5, 0, 0, 7, -1.5));
}

TEST(MatrixMarket, ReadsArraysColumnByColumn) {
  EXPECT_THAT(dense(matrix(array + "2 3\n1\n2\n3\n4\n5\n6\n")), ElementsAre(1, 3, 5, 2, 4, 6));
  EXPECT_EQ(matrix(array + "2 2\n1\n0\n0\n1\n").value.size(), 2u);
}

TEST(MatrixMarket, CompletesSymmetricMatrices) {
  EXPECT_THAT(dense(matrix("%%MatrixMarket matrix coordinate integer symmetric\n2 2 3\n1 1 4\n2 1 -1\n2 2 5\n")),
              ElementsAre(4, -1, -1, 5));
  EXPECT_THAT(dense(matrix("%%matrixmarket MATRIX Array Real SYMMETRIC\n3 3\n1\n2\n3\n4\n5\n6\n")),
              ElementsAre(1, 2, 3, 2, 4, 5, 3, 5, 6));
}

TEST(MatrixMarket, ReadsVectorsOfEitherFormat) {
  EXPECT_THAT(vector(array + "3 1\n1\n2\n3\n", 3), ElementsAre(1, 2, 3));
  EXPECT_THAT(vector(coordinate + "4 1 1\n3 1 2.5\n", 4), ElementsAre(0, 0, 2.5, 0));
}

TEST(MatrixMarket, ReadsInfinitiesWhereTheyMeanSomething) {
  const std::string bounds = array + "5 1\ninf\n-inf\nInf\n+Infinity\n-INFINITY\n";
  EXPECT_THAT(vector(bounds, 5, Infinities::allowed), ElementsAre(infinity, -infinity, infinity, infinity, -infinity));
  EXPECT_EQ(input_error_of([&] { vector(bounds, 5); }), "b.mtx:3: found inf, expected a finite number");
  EXPECT_EQ(input_error_of([&] { matrix(coordinate + "1 1 1\n1 1 -inf\n"); }),
            "A.mtx:3: found -inf, expected a finite number");
}

TEST(MatrixMarket, WritesWhatItReadsToTheLastBit) {
  const std::vector<double> values{1.0 / 3, -0.0, 5e-324, std::numeric_limits<double>::max(), 0.1, -123456789.125};
  EXPECT_EQ(vector(matrix_market(values), 6), values);
  SparseRows A;
  A.rows = 2;
  A.columns = 3;
  A.row = {0, 2, 3};
  A.column = {0, 2, 1};
  A.value = {1.0 / 3, 1e-300, std::nextafter(2.0, 3.0)};
  const SparseRows B = matrix(matrix_market(A));
  EXPECT_EQ(B.columns, A.columns);
  EXPECT_EQ(B.row, A.row);
  EXPECT_EQ(B.column, A.column);
  EXPECT_EQ(B.value, A.value);
}

TEST(MatrixMarket, NamesTheLineWithWhatWasFoundAndExpected) {
  const auto wrong = [](const std::string& text, const std::string& message) {
    EXPECT_THAT(input_error_of([&] { matrix(text); }), StartsWith("A.mtx:" + message)) << text;
  };
  wrong("", "1: found '', expected '%%MatrixMarket matrix coordinate|array");
  wrong("1 2 3\n", "1: found '1 2 3', expected '%%MatrixMarket");
  wrong("\n" + coordinate + "1 1 1\n1 1 1\n", "2: found");
  wrong("%%MatrixMarket matrix coordinate pattern general\n", "1: found 'pattern', expected integer or real");
  wrong("%%MatrixMarket matrix coordinate complex general\n", "1: found 'complex', expected integer or real");
  wrong("%%MatrixMarket matrix coordinate real hermitian\n", "1: found 'hermitian', expected symmetric or general");
  wrong("%%MatrixMarket matrix coordinate real skew-symmetric\n", "1: found 'skew-symmetric', expected symmetric");
  wrong("%%MatrixMarket vector coordinate real general\n", "1: found");
  wrong(coordinate, "1: the file ends where rows, columns and the number of entries are expected");
  wrong(coordinate + "% c\n2 2\n", "3: found '2 2', expected rows, columns and the number of entries");
  wrong(array + "2 2 4\n", "2: found '2 2 4', expected rows and columns");
  wrong(coordinate + "2 x 1\n", "2: found 'x', expected columns from 0");
  wrong(coordinate + "-2 2 1\n", "2: found '-2', expected rows from 0");
  wrong(coordinate + "3000000000 2 1\n", "2: found '3000000000', expected rows from 0 to 2147483646");
  wrong(coordinate + "2 2 -1\n", "2: found '-1', expected a number of entries");
  wrong(coordinate + "2 2 2\n1 1 1.000\n2 2\n", "4: found '2 2', expected row, column and value");
  wrong(coordinate + "2 2 2\n1 1 1\n2 2 1 0\n", "4: found '2 2 1 0', expected row, column and value");
  wrong(coordinate + "2 2 2\n1 1 1\n3 2 1\n", "4: found '3', expected a row from 1 to 2");
  wrong(coordinate + "2 2 2\n1 0 1\n2 2 1\n", "3: found '0', expected a column from 1 to 2");
  wrong(coordinate + "2 2 2\n1 1 1.5.5\n2 2 1\n", "3: found '1.5.5', expected a number");
  wrong(coordinate + "2 2 2\n1 1 nan\n2 2 1\n", "3: found 'nan', expected a number");
  wrong(coordinate + "2 2 2\n1 1 1e999\n2 2 1\n", "3: the value 1e999 is out of range");
  wrong("%%MatrixMarket matrix coordinate integer general\n1 1 1\n1 1 1.5\n", "3: found '1.5', expected an integer");
  wrong(coordinate + "2 2 3\n1 1 1\n2 2 1\n% the end is missing\n", "5: found '% the end is missing', expected row");
  wrong(coordinate + "2 2 3\n1 1 1.0\n2 2 1.0\n\n\n", "6: the file ends after 2 entries, expected 3; is it truncated?");
  wrong(coordinate + "2 2 2\n1 1 1\n2 2 1\n2 1 1\n", "5: found '2 1 1' after all 2 entries, expected the end");
  wrong(coordinate + "2 2 3\n1 1 1\n2 2 1\n1 1 2\n", "5: the entry in row 1, column 1 stands twice");
  const std::string symmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
  wrong(symmetric + "2 2 2\n1 1 1\n1 2 1\n", "4: found row 1, column 2: expected the lower triangle alone");
  wrong(symmetric + "2 2 4\n1 1 1\n2 1 1\n2 2 1\n2 1 5\n", "6: the entry in row 2, column 1 stands twice");
  wrong(symmetric + "2 3 1\n2 1 1\n", "2: found 2 rows and 3 columns, expected as many of each");
  wrong(array + "1 1\n1 2\n", "3: found '1 2', expected one value");
}

TEST(MatrixMarket, RefusesSizesThatTheFileCannotHold) {
  const auto wrong = [](const std::string& text, const std::string& message) {
    EXPECT_THAT(input_error_of([&] { matrix(text); }), HasSubstr(message)) << text;
  };
  wrong(coordinate + "2 2 1000000000000\n1 1 1\n", "1000000000000 entries announced, more than the remaining 6 bytes");
  wrong(array + "2000000000 2000000000\n1\n", "4000000000000000000 entries announced");
  wrong(coordinate + "2000000000 2000000000 1\n1 1 1\n", "2000000000 rows, but 1 entries only");
}

TEST(MatrixMarket, RowsMayBeEmpty) {
  const SparseRows found = matrix(coordinate + "4 4 2\n2 2 7\n4 4 1\n");
  EXPECT_THAT(found.row, ElementsAre(0, 0, 1, 1, 2));
  EXPECT_EQ(matrix(coordinate + "3 3 0\n").rows, 3);
}

TEST(MatrixMarket, ReadsColumnsRowByRow) {
  const auto columns = [](const std::string& text, Index size, Index fewest, Index most) {
    return parse_columns(text, "v.mtx", size, fewest, most);
  };
  const Columns found = columns(array + "3 2\n1\n2\n3\n4\n5\n6\n", 3, 1, 4);
  EXPECT_EQ(found.columns, 2);
  EXPECT_THAT(found.value, ElementsAre(1, 4, 2, 5, 3, 6));
  EXPECT_THAT(columns(coordinate + "2 2 1\n2 1 7\n", 2, 2, 2).value, ElementsAre(0, 0, 7, 0));
  EXPECT_THAT(input_error_of([&] { columns(array + "3 2\n1\n2\n3\n4\n5\n6\n", 3, 3, 3); }),
              HasSubstr("found 3 rows and 2 columns, expected 3 rows and 3 columns"));
  EXPECT_THAT(input_error_of([&] { columns(coordinate + "2 2000000000 1\n1 1 1\n", 2, 1, 32); }),
              HasSubstr("expected 2 rows and 1 to 32 columns"));
  EXPECT_THAT(input_error_of([&] { columns(coordinate + "2 2 2\n2 1 7\n2 1 7\n", 2, 2, 2); }),
              HasSubstr("row 2, column 1"));
  EXPECT_THAT(input_error_of([&] { columns(array + "1 2\n1\ninf\n", 1, 2, 2); }), HasSubstr("finite"));
}

TEST(MatrixMarket, AVectorHasTheSizeThatIsExpected) {
  for (const char* text : {"3 1\n1\n2\n3\n", "1 4\n1\n2\n3\n4\n", "4 2\n1\n2\n3\n4\n1\n2\n3\n4\n"})
    EXPECT_THAT(input_error_of([&] { vector(array + text, 4); }),
                HasSubstr("expected a vector of 4 rows and one column"));
  EXPECT_EQ(input_error_of([] { vector(coordinate + "4 1 2\n3 1 2.5\n3 1 2\n", 4); }),
            "b.mtx:4: the entry in row 3 stands twice");
}

class MatrixMarketFile : public test::Folder {
 protected:
  /// Packed by gzip, in two members.
  std::filesystem::path packed(const std::string& text) const {
    const auto path = folder_ / "x.mtx.gz";
    std::filesystem::remove(path);
    for (const std::string& part : {text.substr(0, text.size() / 2), text.substr(text.size() / 2)}) {
      gzFile file = gzopen(path.c_str(), "ab");
      gzwrite(file, part.data(), static_cast<unsigned>(part.size()));
      gzclose(file);
    }
    return path;
  }
};

TEST_F(MatrixMarketFile, MayBePacked) {
  std::vector<double> values(100000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
  EXPECT_EQ(read_vector(packed(matrix_market(values)), 100000, Infinities::refused), values);
}

TEST_F(MatrixMarketFile, PackedAndDamagedOrCutOffIsRefused) {
  const auto path = packed(matrix_market(std::vector<double>(1000, 1.0 / 3)));
  const auto size = std::filesystem::file_size(path);
  const auto read = [&] { read_vector(path, 1000, Infinities::refused); };
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40);
    file.put('x');
  }
  EXPECT_THAT(input_error_of(read), HasSubstr("x.mtx.gz: the gzip data are damaged or cut off"));
  packed(matrix_market(std::vector<double>(1000, 1.0 / 3)));
  std::filesystem::resize_file(path, size - 1);
  EXPECT_THAT(input_error_of(read), HasSubstr("x.mtx.gz: the gzip data are damaged or cut off"));
}

TEST_F(MatrixMarketFile, ThatIsNotThereIsNamed) {
  EXPECT_THAT(input_error_of([&] { read_matrix(folder_ / "none.mtx"); }),
              HasSubstr("none.mtx: no such Matrix Market file"));
  EXPECT_THAT(input_error_of([&] { read_matrix(folder_); }), HasSubstr("is not a file"));
}

}  // namespace
}  // namespace signorini
