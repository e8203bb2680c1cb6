#include "block_cholesky.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace fpz::sph::detail {

namespace {

/// Parts a set of points again and again.
template <int Dim>
class Dissection {
 public:
  Dissection(const Fields<Dim>& position, const NeighbourLists& neighbours)
      : position_(position), neighbours_(neighbours), side_(neighbours.size(), none) {
    order.reserve(neighbours.size());
    std::vector<int> all(neighbours.size());
    std::iota(all.begin(), all.end(), 0);
    part(all);
  }

  std::vector<int> order;

 private:
  enum Side : char { none, low, high };
  struct Parts {
    std::vector<int> one, other, between;
    double cost = HUGE_VAL;
  };

  void part(const std::vector<int>& points) {
    constexpr std::size_t leaf = 20;
    constexpr std::array places = {0.42, 0.46, 0.5, 0.54, 0.58};
    Parts best;
    if (points.size() > leaf) {
      for (std::size_t c = 0; c < position_.size(); ++c) {
        std::vector<double> x;
        for (const int i : points) x.push_back(position_[c][static_cast<std::size_t>(i)]);
        std::sort(x.begin(), x.end());
        for (const double place : places) {
          try_line(points, c, x[static_cast<std::size_t>(place * static_cast<double>(x.size()))], best);
        }
      }
    }
    if (best.one.empty() || best.other.empty()) {
      order.insert(order.end(), points.begin(), points.end());
      return;
    }
    part(best.one);
    part(best.other);
    order.insert(order.end(), best.between.begin(), best.between.end());
  }

  void try_line(const std::vector<int>& points, std::size_t component, double at, Parts& best) {
    for (const int i : points) {
      side_[static_cast<std::size_t>(i)] = position_[component][static_cast<std::size_t>(i)] < at ? low : high;
    }
    for (const Side near : {low, high}) {
      Parts parts;
      for (const int i : points) {
        if (side_[static_cast<std::size_t>(i)] != near) {
          parts.other.push_back(i);
          continue;
        }
        const std::vector<int>& list = neighbours_[static_cast<std::size_t>(i)];
        const bool across = std::any_of(list.begin(), list.end(), [&](int j) {
          const Side s = side_[static_cast<std::size_t>(j)];
          return s != none && s != near;
        });
        (across ? parts.between : parts.one).push_back(i);
      }
      const double uneven = (static_cast<double>(parts.one.size()) - static_cast<double>(parts.other.size())) /
                            static_cast<double>(points.size());
      parts.cost = static_cast<double>(parts.between.size()) * (1.0 + 2.0 * uneven * uneven);
      if (!parts.one.empty() && !parts.other.empty() && parts.cost < best.cost) best = std::move(parts);
    }
    for (const int i : points) side_[static_cast<std::size_t>(i)] = none;
  }

  const Fields<Dim>& position_;
  const NeighbourLists& neighbours_;
  std::vector<Side> side_;
};

}  // namespace

template <int Dim>
std::vector<int> dissection_order(const Fields<Dim>& position, const NeighbourLists& neighbours) {
  return Dissection<Dim>(position, neighbours).order;
}

template std::vector<int> dissection_order<2>(const Fields<2>&, const NeighbourLists&);

template <int Size>
BlockCholesky<Size>::BlockCholesky(const BlockMatrix<Size>& matrix, const std::vector<int>& order) : order_(order) {
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
  matrix_.row.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (const auto& [column, block] : matrix.row[i]) {
      const int a = place[i], b = place[static_cast<std::size_t>(column)];
      if (a > b) matrix_.row[static_cast<std::size_t>(a)].push_back({b, block});
      if (a < b) matrix_.row[static_cast<std::size_t>(b)].push_back({a, block.transpose()});
    }
  }
  for (const int i : order) matrix_.diagonal.push_back(matrix.diagonal[static_cast<std::size_t>(i)]);
  find_pattern();
  factorise();
  matrix_ = {};
}

template <int Size>
void BlockCholesky<Size>::find_row(int k, std::vector<int>& mark, std::vector<int>& columns) const {
  columns.clear();
  mark[static_cast<std::size_t>(k)] = k;
  for (const auto& entry : matrix_.row[static_cast<std::size_t>(k)]) {
    for (int i = entry.column; mark[static_cast<std::size_t>(i)] != k; i = parent_[static_cast<std::size_t>(i)]) {
      mark[static_cast<std::size_t>(i)] = k;
      columns.push_back(i);
    }
  }
  std::sort(columns.begin(), columns.end());
}

/// Elimination tree (Liu 1986) and the lengths of the columns.
template <int Size>
void BlockCholesky<Size>::find_pattern() {
  const auto count = static_cast<int>(order_.size());
  parent_.assign(order_.size(), -1);
  std::vector<int> root(order_.size(), -1);  // an ancestor, to shorten the way up
  for (int k = 0; k < count; ++k) {
    for (const auto& entry : matrix_.row[static_cast<std::size_t>(k)]) {
      for (int i = entry.column; i != -1 && i < k;) {
        const int next = root[static_cast<std::size_t>(i)];
        root[static_cast<std::size_t>(i)] = k;
        if (next == -1) parent_[static_cast<std::size_t>(i)] = k;
        i = next;
      }
    }
  }
  begin_.assign(order_.size() + 1, 0);
  std::vector<int> mark(order_.size(), -1), columns;
  for (int k = 0; k < count; ++k) {
    find_row(k, mark, columns);
    for (const int i : columns) ++begin_[static_cast<std::size_t>(i) + 1];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
}

/// Row by row: L_ki = (A_ki - sum_j L_kj L_ij^T) L_ii^-T, L_kk L_kk^T = A_kk - sum_i L_ki L_ki^T.
template <int Size>
void BlockCholesky<Size>::factorise() {
  const auto count = static_cast<int>(order_.size());
  row_.resize(begin_.back());
  below_.resize(begin_.back());
  diagonal_.resize(order_.size());
  std::vector<std::size_t> end(begin_.begin(), begin_.end() - 1);
  std::vector<Block> rest(order_.size(), Block::Zero());  // of the row
  std::vector<int> mark(order_.size(), -1), columns;
  for (int k = 0; k < count && ok_; ++k) {
    find_row(k, mark, columns);
    for (const auto& entry : matrix_.row[static_cast<std::size_t>(k)]) {
      rest[static_cast<std::size_t>(entry.column)] += entry.block;
    }
    Block middle = matrix_.diagonal[static_cast<std::size_t>(k)];
    for (const int column : columns) {
      const auto i = static_cast<std::size_t>(column);
      const Block entry = diagonal_[i]
                              .template triangularView<Eigen::Lower>()
                              .template solve<Eigen::OnTheLeft>(rest[i].transpose())
                              .transpose();
      rest[i].setZero();
      for (std::size_t n = begin_[i]; n < end[i]; ++n) {
        rest[static_cast<std::size_t>(row_[n])].noalias() -= entry * below_[n].transpose();
      }
      middle.noalias() -= entry * entry.transpose();
      row_[end[i]] = k;
      below_[end[i]++] = entry;
    }
    const Eigen::LLT<Block> factor(middle);
    ok_ = factor.info() == Eigen::Success;
    diagonal_[static_cast<std::size_t>(k)] = factor.matrixL();
  }
}

template <int Size>
Eigen::VectorXd BlockCholesky<Size>::solve(const Eigen::VectorXd& right) const {
  using Part = Eigen::Matrix<double, Size, 1>;
  std::vector<Part> x;
  for (const int i : order_) x.push_back(right.segment<Size>(Size * i));
  for (std::size_t i = 0; i < x.size(); ++i) {
    diagonal_[i].template triangularView<Eigen::Lower>().solveInPlace(x[i]);
    for (std::size_t n = begin_[i]; n < begin_[i + 1]; ++n) {
      x[static_cast<std::size_t>(row_[n])].noalias() -= below_[n] * x[i];
    }
  }
  for (std::size_t i = x.size(); i-- > 0;) {
    for (std::size_t n = begin_[i]; n < begin_[i + 1]; ++n) {
      x[i].noalias() -= below_[n].transpose() * x[static_cast<std::size_t>(row_[n])];
    }
    diagonal_[i].template triangularView<Eigen::Lower>().transpose().solveInPlace(x[i]);
  }
  Eigen::VectorXd all(right.size());
  for (std::size_t i = 0; i < x.size(); ++i) all.segment<Size>(Size * order_[i]) = x[i];
  return all;
}

template class BlockCholesky<6>;

}  // namespace fpz::sph::detail
