// Cholesky factors of a large, sparse, symmetric and positive definite matrix of small dense blocks, and an order of
// elimination for points in the plane that keeps them sparse.
//
// Serial and with fixed sums: the bits depend on nothing but the matrix.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bonds.hpp"

namespace fpz::sph::detail {

/// Points in the order in which they are to be eliminated: nested dissection. A set is parted by a line across its
/// longer or shorter side, where the neighbours across it are fewest; they come after both parts.
template <int Dim>
[[nodiscard]] std::vector<int> dissection_order(const Fields<Dim>& position, const NeighbourLists& neighbours);

/// The lower triangle of a symmetric matrix by rows of blocks.
template <int Size>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, Size, Size>;
  struct Entry {
    int column;  ///< below its row
    Block block;
  };
  std::vector<std::vector<Entry>> row;  ///< left of the diagonal, any order
  std::vector<Block> diagonal;          ///< whole blocks
};

template <int Size>
class BlockCholesky {
 public:
  /// `order` has every row once. ok() is false when the matrix is not positive definite.
  BlockCholesky(const BlockMatrix<Size>& matrix, const std::vector<int>& order);

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// Numbers in the factor.
  [[nodiscard]] std::size_t entries() const { return (below_.size() + diagonal_.size()) * Size * Size; }

 private:
  using Block = Eigen::Matrix<double, Size, Size>;
  void find_pattern();
  void factorise();
  /// Columns of row k of the factor, ascending; `mark` has k for those that have been seen.
  void find_row(int k, std::vector<int>& mark, std::vector<int>& columns) const;

  BlockMatrix<Size> matrix_;  // in the order of elimination; empty once factorised
  std::vector<int> order_;
  std::vector<int> parent_;         // first row below the diagonal of each column, -1: none
  std::vector<std::size_t> begin_;  // of each column in below_
  std::vector<int> row_;
  std::vector<Block> below_, diagonal_;
  bool ok_ = true;
};

extern template class BlockCholesky<6>;

}  // namespace fpz::sph::detail
