// Against a dense factorisation, on a cloud of points.
#include "block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

#include "setups.hpp"

namespace fpz::sph::test {
namespace {

using Matrix = detail::BlockMatrix<6>;

constexpr std::size_t columns = 12, rows = 9, count = columns * rows;

struct Cloud {
  Fields<2> position;
  detail::NeighbourLists neighbours;
};

Cloud cloud() {
  Cloud c;
  for (Field& x : c.position) x.resize(count);
  const RunSetup<2> s = block(columns, rows, 0.3, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 2; ++k) c.position[k][i] = s.arrangement.position[i][static_cast<int>(k)];
  }
  detail::Team alone(1);
  c.neighbours = detail::find_neighbours<2>(alone, c.position, count, 2.4);
  return c;
}

/// Couples neighbours; positive definite by its diagonal.
Matrix random_matrix(const detail::NeighbourLists& neighbours) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto block_of = [&] { return Matrix::Block::NullaryExpr([&] { return uniform(rng); }).eval(); };
  Matrix m;
  m.row.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Matrix::Block b = block_of();
    m.diagonal.push_back(b * b.transpose() + 60.0 * Matrix::Block::Identity());
    for (const int j : neighbours[i]) {
      if (j < static_cast<int>(i)) m.row[i].push_back({j, block_of()});
    }
  }
  return m;
}

Eigen::MatrixXd dense(const Matrix& m) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(6 * count, 6 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<Eigen::Index>(6 * i);
    all.block<6, 6>(at, at) = m.diagonal[i];
    for (const auto& [column, block] : m.row[i]) {
      all.block<6, 6>(at, 6 * column) = block;
      all.block<6, 6>(6 * column, at) = block.transpose();
    }
  }
  return all;
}

TEST(BlockCholesky, SolvesAsADenseFactorisation) {
  const Cloud c = cloud();
  const Matrix m = random_matrix(c.neighbours);
  const Eigen::MatrixXd all = dense(m);
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(6 * count, -1.0, 2.0);
  const Eigen::VectorXd exact = all.llt().solve(right);
  std::vector<int> natural(count);
  std::iota(natural.begin(), natural.end(), 0);
  const std::vector<int> dissected = detail::dissection_order<2>(c.position, c.neighbours);
  for (const std::vector<int>& order : {natural, dissected}) {
    const detail::BlockCholesky<6> factors(m, order);
    ASSERT_TRUE(factors.ok());
    EXPECT_LT((factors.solve(right) - exact).norm(), 1e-12 * exact.norm());
  }
}

TEST(BlockCholesky, AnIndefiniteMatrixIsToldOf) {
  const Cloud c = cloud();
  Matrix m = random_matrix(c.neighbours);
  m.diagonal[count / 2](3, 3) = -1.0;
  EXPECT_FALSE(detail::BlockCholesky<6>(m, detail::dissection_order<2>(c.position, c.neighbours)).ok());
}

TEST(BlockCholesky, DissectionHasEveryPointOnceAndKeepsTheFactorSparse) {
  const Cloud c = cloud();
  std::vector<int> order = detail::dissection_order<2>(c.position, c.neighbours);
  const Matrix m = random_matrix(c.neighbours);
  std::vector<int> scrambled(count);
  std::iota(scrambled.begin(), scrambled.end(), 0);
  std::shuffle(scrambled.begin(), scrambled.end(), std::mt19937_64(4));
  EXPECT_LT(detail::BlockCholesky<6>(m, order).entries(), detail::BlockCholesky<6>(m, scrambled).entries() * 2 / 3);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(order[i], static_cast<int>(i));
}

}  // namespace
}  // namespace fpz::sph::test
