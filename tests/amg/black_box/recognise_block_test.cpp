// Which unknowns belong together is seen from the matrix, and dense or scalar ones are not mistaken for blocks.
#include "amg/black_box/recognise_block.hpp"

#include <gtest/gtest.h>

#include "amg/black_box.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix permuted(const Matrix& A, const std::vector<int>& to) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < A.outerSize(); ++k)
    for (Matrix::InnerIterator entry(A, k); entry; ++entry)
      entries.emplace_back(to[entry.row()], to[entry.col()], entry.value());
  Matrix out(A.rows(), A.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

TEST(RecognisedBlock, IsTheNumberOfComponentsOfElasticBodies) {
  for (const auto& c : plane_cases()) EXPECT_EQ(recognised_block(Given<2>(c.nested.finest()).A), 2) << c.name;
  for (const auto& c : space_cases()) EXPECT_EQ(recognised_block(Given<3>(c.nested.finest()).A), 3) << c.name;
}

// Their components hardly couple beside the stiff direction.
TEST(RecognisedBlock, CellsMayBeStretched) {
  for (const double stretch : {10, 50, 200, 1000}) {
    EXPECT_EQ(recognised_block(sparse(stiffness<2, 2>(rectangle({0, 0}, {stretch, 1}, {20, 20}), Model<2>{}))), 2)
        << stretch;
    EXPECT_EQ(recognised_block(sparse(stiffness<3, 3>(box({0, 0, 0}, {stretch, stretch, 1}, {6, 6, 6}), Model<3>{}))),
              3)
        << stretch;
  }
}

TEST(RecognisedBlock, EntriesThatAreZeroDoNotHideIt) {
  Matrix A = Given<2>(plane_cases().front().nested.finest()).A;
  A.prune(0.0);
  EXPECT_EQ(recognised_block(A), 2);
}

TEST(RecognisedBlock, IsOneForScalarsInAnyEvenNumber) {
  EXPECT_EQ(recognised_block(laplacian(7)), 1);
  EXPECT_EQ(recognised_block(laplacian(13)), 1);
  for (const auto& c : scalar_cases()) EXPECT_EQ(recognised_block(Given<1>(c.nested.finest()).A), 1) << c.name;
}

TEST(RecognisedBlock, IsOneForDenseAndBandedMatrices) {
  const Matrix dense = (Eigen::MatrixXd::Ones(12, 12) + Eigen::MatrixXd::Identity(12, 12)).sparseView();
  EXPECT_EQ(recognised_block(dense), 1);
  for (const int width : {1, 2, 3, 5}) {
    Eigen::MatrixXd band = 10 * Eigen::MatrixXd::Identity(60, 60);
    for (int i = 0; i < 60; ++i)
      for (int j = 0; j < 60; ++j)
        if (i != j && std::abs(i - j) <= width) band(i, j) = -1;
    EXPECT_EQ(recognised_block(Matrix(band.sparseView())), 1) << width;
  }
}

TEST(RecognisedBlock, IsOneForFullMatricesOfAnySize) {
  for (int n = 1; n <= 24; ++n) {
    Eigen::MatrixXd full = -Eigen::MatrixXd::Ones(n, n);
    full.diagonal().setConstant(std::max(1, n - 1));  // two rows: those of a spring
    const Matrix A = full.sparseView();
    EXPECT_EQ(recognised_block(A), 1) << n;
    for (const int bodies : {2, 3, 12}) EXPECT_EQ(recognised_block(copies(bodies, A)), 1) << bodies << " of " << n;
  }
}

TEST(RecognisedBlock, IsOneForFewScalarsThatLookLikeBlocksByChance) {
  Matrix pairs(4, 4);  // of each pair, both are tied to those of the other one, but not to each other
  for (int i = 0; i < 4; ++i) {
    pairs.insert(i, i) = 2;
    for (const int j : {(i + 2) % 4, 3 - i}) pairs.insert(i, j) = -1;
  }
  EXPECT_EQ(recognised_block(pairs), 1);
}

TEST(RecognisedBlock, IsOneForTwoProblemsWithoutCouplingAndComponentsOneAfterTheOther) {
  const Matrix A = laplacian(8);
  const auto n = static_cast<int>(A.rows());
  std::vector<int> alternate(2 * n), apart(2 * n);
  for (int i = 0; i < n; ++i) {
    alternate[i] = 2 * i;
    alternate[n + i] = 2 * i + 1;
  }
  EXPECT_EQ(recognised_block(permuted(copies(2, A), alternate)), 1);
  const Matrix elastic = Given<2>(plane_cases().front().nested.finest()).A;
  const auto vectors = static_cast<int>(elastic.rows()) / 2;
  for (int i = 0; i < vectors; ++i) {
    apart.resize(elastic.rows());
    apart[2 * i] = i;
    apart[2 * i + 1] = vectors + i;
  }
  EXPECT_EQ(recognised_block(permuted(elastic, apart)), 1);
}

TEST(RecognisedBlock, IsOneForWhatIsNoMatrix) {
  SparseRows A;
  EXPECT_EQ(recognised_block(A), 1);
  A.rows = A.columns = 2;
  EXPECT_EQ(recognised_block(A), 1);
  A.row = {0, 1, 2};
  A.column = {0, 7};
  A.value = {1, 1};
  EXPECT_EQ(recognised_block(A), 1);
}

// A black box that is told nothing does what one does that is told the block.
TEST(RecognisedBlock, IsTakenWhereNoneIsGiven) {
  const auto problem = plane_cases().front().nested.finest();
  const Given<2> given(problem);
  const auto told = BlackBox(given.A, 2).solve(given.b, given.lower, given.upper);
  const auto found = BlackBox(given.A).solve(given.b, given.lower, given.upper);
  EXPECT_EQ(found.x, told.x);
  EXPECT_EQ(found.summary.iterations, told.summary.iterations);
}

}  // namespace
}  // namespace signorini::test
